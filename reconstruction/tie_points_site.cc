// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/tie_points_site.h"

#include <algorithm>
#include <map>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "calibration/photo/distinct_photographs.h"
#include "calibration/photo/photograph.h"
#include "reconstruction/adjustment/align_tie_points.h"
#include "reconstruction/colmap/colmap_subset.h"
#include "reconstruction/colmap/colmap_text.h"
#include "reconstruction/colmap/read_colmap_model.h"
#include "reconstruction/site_photos.h"
#include "reconstruction/survey/read_survey.h"
#include "reconstruction/survey/survey.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

std::map<std::string, Camera> CamerasByPhoto(const std::vector<fs::path>& photos,
                                             const std::vector<Camera>& cameras) {
  std::map<std::string, Camera> by_photo;
  for (size_t i = 0; i < photos.size(); ++i) by_photo.emplace(photos[i].stem(), cameras[i]);
  return by_photo;
}

// What there is of a survey: matching needs it to merge models and to find neighbours only.
Survey SurveyIfAny(const SitePaths& site, const std::vector<fs::path>& photos) {
  std::vector<std::string> names;
  for (const fs::path& photo : photos) names.push_back(photo.stem());
  return ReadSurvey(site, names, SurveyFolder::kOptional);
}

std::vector<MatchedModel> ModelsOfColmap(const SitePaths& site, const std::vector<fs::path>& photos,
                                         const std::vector<Camera>& cameras, const Survey& survey,
                                         const ColmapOptions& options) {
  std::vector<MatchingPhoto> matching;
  for (size_t i = 0; i < photos.size(); ++i) {
    matching.push_back({photos[i], cameras[i]});
    for (const CameraPosition& surveyed : survey.camera_positions) {
      if (surveyed.photo == photos[i].stem()) matching.back().center = surveyed.position;
    }
  }
  std::vector<MatchedModel> models = RunColmap(matching, site.tie_points().parent_path(), options);
  if (!models.empty()) return models;
  throw InputError(
      site.photos(),
      "COLMAP connects no two of the " + std::to_string(photos.size()) +
          " photographs, expected ones that overlap by half or more and show texture "
          "from places some steps apart, or three control points marked on each; its logs "
          "are in " +
          (site.tie_points().parent_path() / "logs").string());
}

// Image for image the photographs of the site, under their own names, of the sizes of their
// cameras. What else it holds is left out and told.
ColmapModel SiteModel(const fs::path& folder, const std::vector<fs::path>& photos,
                      const std::vector<Camera>& cameras, std::vector<std::string>* remarks) {
  ColmapModel model = ReadColmapModel(folder);
  std::set<uint32_t> of_site;
  std::vector<std::string> others;
  for (auto& [id, image] : model.images) {
    const fs::path name = fs::path(image.name).filename();
    const auto photo = std::find_if(photos.begin(), photos.end(), [&](const fs::path& path) {
      return path.filename() == name || path.stem() == name.stem();
    });
    if (photo == photos.end()) {
      others.push_back(image.name);
      continue;
    }
    const Camera& camera = cameras[static_cast<size_t>(photo - photos.begin())];
    const ColmapLens& lens = model.cameras.at(image.camera);
    if (lens.width != camera.width() || lens.height != camera.height()) {
      throw InputError(folder, "its image '" + image.name + "' is " +
                                   SizeText(lens.width, lens.height) + ", expected " +
                                   SizeText(camera.width(), camera.height()) +
                                   ": keypoints must be those of the original photographs");
    }
    image.name = photo->filename();
    of_site.insert(id);
  }
  if (of_site.size() < 2) {
    throw InputError(folder, "holds " + std::to_string(of_site.size()) +
                                 " photographs of this site, expected two or more; " +
                                 Listing("not in the folder photos", others));
  }
  if (others.empty()) return model;
  remarks->push_back("images of the model that are " + Listing("not in the folder photos", others) +
                     " are left out");
  KeepImages(of_site, &model);
  return model;
}

MatchedModel BroughtModel(const fs::path& folder, const std::vector<fs::path>& photos,
                          const std::vector<Camera>& cameras) {
  std::vector<std::string> remarks;
  MatchedModel model;
  model.colmap = SiteModel(folder, photos, cameras, &remarks);
  model.tie_points = TiePointsFromColmap(model.colmap);
  model.tie_points.remarks = remarks;
  model.tie_points.program = "COLMAP, its model brought";
  model.tie_points.program_version = "unknown";
  return model;
}

std::vector<std::string> NamesOf(const TiePoints& tie_points) {
  std::vector<std::string> names;
  for (const auto& [name, pose] : tie_points.cam_from_model) names.push_back(name);
  return names;
}

// Adds what `main` does not have yet. Photographs in both keep the pose of `main`; points with a
// mark that `main` has already are left out.
void Add(const TiePoints& other, TiePoints* main) {
  std::set<std::tuple<std::string, double, double>> used;
  for (const TiePoint& point : main->points) {
    for (const TiePointMark& mark : point.marks) {
      used.emplace(mark.photo, mark.pixel.x(), mark.pixel.y());
    }
  }
  main->cam_from_model.insert(other.cam_from_model.begin(), other.cam_from_model.end());
  for (const TiePoint& point : other.points) {
    const bool is_new = std::none_of(point.marks.begin(), point.marks.end(), [&](const auto& mark) {
      return used.contains({mark.photo, mark.pixel.x(), mark.pixel.y()});
    });
    if (is_new) main->points.push_back(point);
  }
}

// The largest model with those that share its control, in its frame.
TiePoints Merged(std::vector<MatchedModel> models, const Survey& survey,
                 const std::map<std::string, Camera>& cameras) {
  TiePoints merged = models[0].tie_points;
  const auto world_from_main = FitSimilarity(FindModelControl(survey, cameras, merged).pairs);
  for (size_t i = 1; i < models.size(); ++i) {
    const TiePoints& other = models[i].tie_points;
    const auto world_from_other = FitSimilarity(FindModelControl(survey, cameras, other).pairs);
    const std::string photos = QuotedList(NamesOf(other));
    if (!world_from_main || !world_from_other) {
      merged.remarks.push_back("the photos " + photos +
                               " are connected among themselves only and were left out; mark three "
                               "control points on two of them and on two of the others");
      continue;
    }
    TiePoints moved = other;
    Transform(Inverse(world_from_main->target_from_source) * world_from_other->target_from_source,
              &moved);
    Add(moved, &merged);
    merged.remarks.push_back("the photos " + photos +
                             " are connected to the others by control points only");
  }
  return merged;
}

void NameWhatIsMissing(const std::vector<fs::path>& photos, TiePoints* tie_points) {
  for (const fs::path& photo : photos) {
    if (!tie_points->cam_from_model.contains(photo.stem())) {
      tie_points->not_placed.push_back(photo.stem());
    }
  }
  if (tie_points->not_placed.empty()) return;
  tie_points->remarks.push_back("image matching could not place " +
                                QuotedList(tie_points->not_placed) +
                                ": it needs three control points of its own");
}

}  // namespace

void TiePointsOptions::Check() const {
  colmap.Check();
  selection.Check();
}

SiteTiePoints MakeTiePoints(const SitePaths& site, const std::vector<fs::path>& photos,
                            const std::vector<Camera>& cameras, const TiePointsOptions& options) {
  options.Check();
  INSITU_CHECK(photos.size() == cameras.size());
  if (photos.size() < 2) throw InputError(site.photos(), "one photograph, expected two or more");
  RequireSizes(photos, cameras);
  RequireDistinctPhotographs(photos);
  const auto by_photo = CamerasByPhoto(photos, cameras);
  const Survey survey = SurveyIfAny(site, photos);
  std::vector<MatchedModel> models;
  if (options.model.empty()) {
    models = ModelsOfColmap(site, photos, cameras, survey, options.colmap);
  } else {
    models = {BroughtModel(options.model, photos, cameras)};
  }
  SiteTiePoints result;
  result.tie_points = Merged(models, survey, by_photo);
  NameWhatIsMissing(photos, &result.tie_points);
  result.counts = SelectTiePoints(by_photo, options.selection, &result.tie_points);
  WriteColmapText(site.tie_points().parent_path() / "model", models[0].colmap);
  WriteTiePoints(site, result.tie_points);
  return result;
}

bool NeedsTiePoints(const SitePaths& site) {
  const std::vector<fs::path> photos = ListPhotographs(site);
  const Survey survey = SurveyIfAny(site, photos);
  std::set<std::string> control;
  for (const ControlPoint& point : survey.control_points) {
    if (point.role == ControlRole::kControl) control.insert(point.name);
  }
  return std::any_of(photos.begin(), photos.end(), [&](const fs::path& photo) {
    return std::count_if(survey.observations.begin(), survey.observations.end(),
                         [&](const ImageObservation& mark) {
                           return mark.photo == photo.stem() && control.contains(mark.point);
                         }) < 3;
  });
}

SiteTiePoints MakeTiePoints(const SitePaths& site, const TiePointsOptions& options) {
  const SitePhotos photos = ReadSitePhotos(site);
  return MakeTiePoints(site, photos.paths, photos.cameras, options);
}

std::string SiteTiePoints::BriefReport() const {
  const size_t placed = tie_points.cam_from_model.size();
  std::string text =
      std::to_string(placed) + " of " + std::to_string(placed + tie_points.not_placed.size()) +
      " photos placed, " + std::to_string(counts.kept) + " of " + std::to_string(counts.found) +
      " tie points kept, sigma of a mark " + Number("%.2f px\n", tie_points.sigma_px);
  text += "dropped: " + std::to_string(counts.marks_off) + " marks off; " +
          std::to_string(counts.too_few_rays) + " points of one photo, " +
          std::to_string(counts.weak_angle) + " under a small angle, " +
          std::to_string(counts.crowded) + " in crowded places\n";
  for (const std::string& remark : tie_points.remarks) text += "warning: " + remark + "\n";
  return text;
}

}  // namespace insitu
