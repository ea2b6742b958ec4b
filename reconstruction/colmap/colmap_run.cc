// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_run.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <sstream>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/external_program.h"
#include "calibration/program/program.h"
#include "reconstruction/colmap/ideal_frame.h"
#include "reconstruction/colmap/read_colmap_model.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// What a photograph is called within COLMAP: names of any letters, blanks included, stay outside.
std::string ColmapName(size_t photo, const std::string& ending) {
  return Formatted("%06zu", photo + 1) + ending;
}

class Run {
 public:
  Run(const std::vector<MatchingPhoto>& photos, const fs::path& folder,
      const ColmapOptions& options)
      : photos_(photos), folder_(fs::absolute(folder)), options_(options) {
    for (const char* part : {"images", "logs", "models"}) {
      fs::remove_all(folder_ / part);
      fs::create_directories(folder_ / part);
    }
    fs::remove(database_path());
  }

  std::vector<MatchedModel> Models() {
    Progress progress("finding tie points", 5);
    WriteImages();
    WriteColmapDatabase(database_path(), EmptyDatabase());
    progress.Step();
    Colmap("feature_extractor",
           {"--database_path", database_path(), "--image_path", folder_ / "images",
            "--image_list_path", folder_ / "images.txt", "--SiftExtraction.use_gpu", "0",
            "--SiftExtraction.max_image_size", std::to_string(options_.max_image_size)});
    progress.Step();
    database_ = ReadColmapDatabase(database_path());
    WriteMatches();
    MoveToIdealFrames();
    progress.Step();
    Colmap("matches_importer", {"--database_path", database_path(), "--match_list_path",
                                folder_ / "matches.txt", "--match_type", "raw",
                                "--SiftMatching.use_gpu", "0", "--SiftMatching.num_threads", "1"});
    progress.Step();
    RunMapper();
    return ReadModels();
  }

 private:
  fs::path database_path() const { return folder_ / "database.db"; }

  void Colmap(const std::string& command, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--random_seed", "0"});
    RunProgram(command, arguments);
  }

  void RunProgram(const std::string& command, const std::vector<std::string>& arguments) const {
    ExternalProgram program;
    program.command = {"colmap", command};
    program.command.insert(program.command.end(), arguments.begin(), arguments.end());
    program.package = "colmap";
    program.folder = folder_;
    program.output = program.log = folder_ / "logs" / (command + ".log");
    RunExternal(program);
  }

  // Its help begins "COLMAP 3.8 -- Structure-from-Motion ...".
  std::string Version() const {
    RunProgram("help", {});
    std::istringstream words(ReadWhole(folder_ / "logs/help.log"));
    std::string name, version;
    words >> name >> version;
    return name == "COLMAP" ? version : "unknown";
  }

  // JPEG files as they are; what COLMAP might read otherwise than we do becomes 8-bit PNG.
  void WriteImages() {
    std::string list;
    for (size_t i = 0; i < photos_.size(); ++i) {
      std::string ending = photos_[i].file.extension();
      std::transform(ending.begin(), ending.end(), ending.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      const bool is_jpeg = ending == ".jpg" || ending == ".jpeg";
      names_.push_back(ColmapName(i, is_jpeg ? ".jpg" : ".png"));
      const fs::path image = folder_ / "images" / names_.back();
      if (is_jpeg) {
        fs::create_symlink(fs::absolute(photos_[i].file), image);
      } else {
        WritePng(image, ReadPhotograph(photos_[i].file).linear, Encoding::kSrgb8);
      }
      list += names_.back() + "\n";
    }
    WriteWhole(folder_ / "images.txt", list);
  }

  // Images have the ids 1, 2, ... in the order of the photographs.
  const MatchingPhoto& PhotoOf(uint32_t image) const { return photos_.at(image - 1); }

  // The lens is COLMAP's own if it has it and its principal point lies on the photograph.
  static std::optional<ColmapLens> KnownLens(const Camera& camera) {
    const auto lens = ColmapFromCamera(camera);
    if (!lens || !camera.Sees({camera.intrinsics()[2], camera.intrinsics()[3]}))
      return std::nullopt;
    return lens;
  }

  // A lens that COLMAP does not know is a pinhole until its keypoints have moved.
  ColmapDatabase EmptyDatabase() const {
    ColmapDatabase database;
    for (uint32_t image = 1; image <= photos_.size(); ++image) {
      const Camera& camera = PhotoOf(image).camera;
      const uint32_t id = CameraId(image);
      database.images[image] = {names_[image - 1], id};
      database.cameras[id] = KnownLens(camera).value_or(*ColmapFromCamera(
          Camera::Pinhole(camera.focal_px(), camera.focal_px(), 0.5 * camera.width(),
                          0.5 * camera.height(), camera.width(), camera.height())));
    }
    return database;
  }

  // Photographs of one camera share the id of the first of them.
  uint32_t CameraId(uint32_t image) const {
    const Camera& camera = PhotoOf(image).camera;
    uint32_t id = 1;
    while (PhotoOf(id).camera.lens_model() != camera.lens_model() ||
           PhotoOf(id).camera.intrinsics() != camera.intrinsics() ||
           PhotoOf(id).camera.width() != camera.width() ||
           PhotoOf(id).camera.height() != camera.height()) {
      ++id;
    }
    return id;
  }

  void WriteMatches() const {
    std::map<uint32_t, Eigen::Vector3d> centers;
    for (uint32_t image = 1; image <= photos_.size(); ++image) {
      if (PhotoOf(image).center) centers[image] = *PhotoOf(image).center;
    }
    const auto descriptors = ReadColmapDescriptors(database_path(), database_);
    const auto pairs = ChoosePairs(database_.features, descriptors, centers, options_.pairs);
    std::vector<ColmapMatches> matches(pairs.size());
    Progress progress("matching features", static_cast<int>(pairs.size()));
    tbb::parallel_for(size_t{0}, pairs.size(), [&](size_t i) {
      matches[i] = MatchFeatures(descriptors.at(pairs[i].first), descriptors.at(pairs[i].second),
                                 options_.matching);
      progress.Step();
    });
    std::string text;
    for (size_t i = 0; i < pairs.size(); ++i) {
      if (matches[i].empty()) continue;
      text += names_[pairs[i].first - 1] + " " + names_[pairs[i].second - 1] + "\n";
      for (const auto& [first, second] : matches[i]) {
        text += std::to_string(first) + " " + std::to_string(second) + "\n";
      }
      text += "\n";
    }
    WriteWhole(folder_ / "matches.txt", text);
  }

  void MoveToIdealFrames() const {
    std::map<uint32_t, ColmapLens> cameras;
    std::map<uint32_t, ColmapFeatures> features;
    for (const auto& [image, original] : database_.features) {
      const Camera& camera = PhotoOf(image).camera;
      if (KnownLens(camera)) continue;
      const Camera ideal = IdealFrame(camera);
      cameras[database_.images.at(image).camera] = *ColmapFromCamera(ideal);
      ColmapFeatures moved = original;
      for (Eigen::Index i = 0; i < moved.rows(); ++i) {
        const Eigen::Vector2d pixel =
            PixelFromColmap(original.row(i).head<2>().transpose().cast<double>());
        const Eigen::Vector2d there = ColmapFromPixel(IdealFromPixel(ideal, camera, pixel));
        moved.row(i).head<2>() = there.transpose().cast<float>();
      }
      features[image] = moved;
    }
    if (!features.empty()) UpdateColmapDatabase(database_path(), cameras, features);
  }

  // No model at all is an answer, which COLMAP 3.8 gives with or without a failing status.
  void RunMapper() const {
    try {
      Colmap("mapper",
             {"--database_path", database_path(), "--image_path", folder_ / "images",
              "--output_path", folder_ / "models", "--Mapper.num_threads", "1",
              "--Mapper.ba_refine_focal_length", "0", "--Mapper.ba_refine_principal_point", "0",
              "--Mapper.ba_refine_extra_params", "0", "--Mapper.extract_colors", "0",
              "--Mapper.min_model_size", "2", "--Mapper.tri_ignore_two_view_tracks", "0",
              // calibrated lenses are not to be doubted
              "--Mapper.min_focal_length_ratio", "0.001", "--Mapper.max_focal_length_ratio", "1000",
              "--Mapper.max_extra_param", "1e9"});
    } catch (const InputError&) {
      const std::string log = ReadWhole(folder_ / "logs/mapper.log");
      if (log.find("No good initial image pair found") == std::string::npos) throw;
    }
  }

  std::vector<MatchedModel> ReadModels() const {
    std::map<std::string, fs::path> folders;  // sorted, so that equals stay in order
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "models")) {
      if (HasColmapModel(entry.path())) folders[entry.path().filename()] = entry.path();
    }
    const std::string version = Version();
    std::vector<MatchedModel> models;
    for (const auto& [name, path] : folders) {
      MatchedModel model;
      model.colmap = ReadColmapModel(path);
      if (model.colmap.images.size() < 2) continue;
      for (auto& [id, image] : model.colmap.images) image.name = PhotoOf(id).file.filename();
      model.tie_points = TiePointsFromColmap(model.colmap, &database_.features);
      model.tie_points.program = "COLMAP";
      model.tie_points.program_version = version;
      models.push_back(std::move(model));
    }
    std::stable_sort(models.begin(), models.end(), [](const auto& a, const auto& b) {
      return a.colmap.images.size() > b.colmap.images.size();
    });
    return models;
  }

  const std::vector<MatchingPhoto>& photos_;
  const fs::path folder_;
  const ColmapOptions& options_;
  std::vector<std::string> names_;  // of the images in COLMAP
  ColmapDatabase database_;         // with the features where they are in the photographs
};

}  // namespace

void ColmapOptions::Check() const {
  pairs.Check();
  matching.Check();
  INSITU_CHECK(max_image_size > 0);
}

std::vector<MatchedModel> RunColmap(const std::vector<MatchingPhoto>& photos,
                                    const fs::path& folder, const ColmapOptions& options) {
  options.Check();
  return Run(photos, folder, options).Models();
}

TiePoints TiePointsFromColmap(const ColmapModel& model,
                              const std::map<uint32_t, ColmapFeatures>* features) {
  TiePoints tie_points;
  std::map<uint32_t, std::string> photo_of_image;
  for (const auto& [id, image] : model.images) {
    photo_of_image[id] = fs::path(image.name).stem();
    tie_points.cam_from_model[photo_of_image[id]] = image.cam_from_world;
  }
  for (const auto& [id, point] : model.points) {
    TiePoint tie_point{point.position, {}};
    for (const ColmapTrackElement& element : point.track) {
      const Eigen::Vector2d position =
          features ? Eigen::Vector2d(features->at(element.image)
                                         .row(element.keypoint)
                                         .head<2>()
                                         .transpose()
                                         .cast<double>())
                   : model.images.at(element.image).keypoints[element.keypoint].position;
      tie_point.marks.push_back({photo_of_image[element.image], PixelFromColmap(position)});
    }
    tie_points.points.push_back(std::move(tie_point));
  }
  return tie_points;
}

}  // namespace insitu
