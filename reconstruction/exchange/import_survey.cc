// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/import_survey.h"

#include <algorithm>

#include "calibration/files/delimited_rows.h"
#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
#include "calibration/files/text_table.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "reconstruction/exchange/read_survey_file.h"
#include "reconstruction/exchange/survey_crs.h"

namespace insitu {
namespace {

InputError ErrorAt(const FilePlace& place, const std::string& message) {
  return InputError(place.path, place.line, message);
}

std::string Said(const FilePlace& place) {
  return place.path.filename().string() + ":" + std::to_string(place.line);
}

std::string Counted(size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void CheckName(const std::string& name, const FilePlace& place) {
  const bool is_plain = !name.empty() && name.find_first_of("\n\r") == std::string::npos;
  if (!is_plain) throw ErrorAt(place, "\"" + name + "\" cannot be a name in our tables");
}

Eigen::Vector3d SigmaOf(const SurveyedPoint& point, const SurveyImportOptions& options) {
  if (point.sigma) return *point.sigma;
  if (options.sigma_m) return Eigen::Vector3d::Constant(*options.sigma_m);
  throw ErrorAt(point.place,
                "the file states no accuracy of \"" + point.name + "\", give it with --sigma-m");
}

// Two files may hold the same point; then they must agree.
template <typename Kept>
const Kept* Find(const std::map<std::string, Kept>& kept, const SurveyedPoint& point) {
  const auto same = kept.find(point.name);
  if (same == kept.end()) return nullptr;
  if ((same->second.position - point.position).norm() > 1e-6) {
    throw ErrorAt(point.place,
                  "\"" + point.name + "\" stands at another place in " + Said(same->second.place));
  }
  return &same->second;
}

std::vector<ControlPoint> MergePoints(const std::vector<SurveyFile>& files,
                                      const SurveyImportOptions& options) {
  std::map<std::string, ControlPoint> kept;
  std::vector<ControlPoint> points;
  for (const SurveyFile& file : files) {
    for (const SurveyedPoint& point : file.points) {
      CheckName(point.name, point.place);
      if (Find(kept, point)) continue;
      const bool is_check = options.check_points.contains(point.name);
      points.push_back({point.name, point.position, SigmaOf(point, options),
                        is_check ? ControlRole::kCheck : point.role, point.place});
      kept.emplace(point.name, points.back());
    }
  }
  for (const std::string& name : options.check_points) {
    if (!kept.contains(name)) throw InputError("--check", "no file holds point \"" + name + "\"");
  }
  return points;
}

std::string SitePhoto(const std::string& name, const SurveyImportOptions& options) {
  const auto renamed = options.photo_names.find(name);
  return renamed == options.photo_names.end() ? name : renamed->second;
}

// The files' photos under other names of the same letters: case, composed or decomposed accents.
// Each where one photo of the site alone is meant.
std::map<std::string, std::string> NamesOfOtherCase(const std::vector<SurveyFile>& files,
                                                    const std::set<std::string>& photos,
                                                    std::vector<std::string>* report) {
  std::map<std::string, std::vector<std::string>> photos_of_letters;
  for (const std::string& photo : photos)
    photos_of_letters[Folded(Composed(photo))].push_back(photo);
  std::map<std::string, std::string> names;
  const auto take = [&](const std::string& name) {
    if (photos.contains(name) || names.contains(name)) return;
    const auto same = photos_of_letters.find(Folded(Composed(name)));
    if (same == photos_of_letters.end() || same->second.size() > 1) return;
    names[name] = same->second[0];
    report->push_back("photo \"" + name + "\" is taken for the site's \"" + same->second[0] + "\"");
  };
  for (const SurveyFile& file : files) {
    for (const SurveyedMark& mark : file.marks) take(mark.photo);
    for (const SurveyedPoint& center : file.centers) take(center.name);
  }
  return names;
}

std::vector<CameraPosition> MergeCenters(const std::vector<SurveyFile>& files,
                                         const std::set<std::string>& photos,
                                         const SurveyImportOptions& options) {
  std::map<std::string, CameraPosition> kept;
  std::vector<CameraPosition> centers;
  for (const SurveyFile& file : files) {
    for (SurveyedPoint center : file.centers) {
      center.name = SitePhoto(center.name, options);
      if (!photos.contains(center.name) || Find(kept, center)) continue;
      centers.push_back({center.name, center.position, SigmaOf(center, options),
                         PositionRole::kWeighted, center.place});
      kept.emplace(center.name, centers.back());
    }
  }
  return centers;
}

// What is left out of the marks, and why.
struct LeftOut {
  std::set<std::string> photos, points;
  size_t of_photos = 0, of_points = 0;

  void Report(std::vector<std::string>* report) const {
    if (of_photos) {
      report->push_back(Counted(of_photos, "mark") +
                        " left out: on photos that are not in the "
                        "folder photos (" +
                        *photos.begin() + (photos.size() > 1 ? " ..." : "") + ")");
    }
    if (of_points) {
      report->push_back(Counted(of_points, "mark") + " left out: of points without coordinates (" +
                        *points.begin() + (points.size() > 1 ? " ..." : "") + ")");
    }
  }
};

double SigmaOf(const SurveyedMark& mark, const SurveyImportOptions& options) {
  if (mark.sigma_px) return *mark.sigma_px;
  if (options.mark_sigma_px) return *options.mark_sigma_px;
  throw ErrorAt(mark.place,
                "the file states no accuracy of its marks, give it with "
                "--mark-sigma-px");
}

// Whether a mark is new; the same mark twice is one, two marks of a point on a photo are an error.
bool IsNew(const std::map<std::pair<std::string, std::string>, ImageObservation>& kept,
           const ImageObservation& mark) {
  const auto same = kept.find({mark.photo, mark.point});
  if (same == kept.end()) return true;
  if ((same->second.pixel - mark.pixel).norm() <= 1e-6) return false;
  throw ErrorAt(mark.place, "point \"" + mark.point + "\" is marked on \"" + mark.photo +
                                "\" elsewhere in " + Said(same->second.place));
}

void CheckOnFrame(const ImageObservation& mark, const PhotoSize& photo_size) {
  const auto size = photo_size(mark.photo);
  if (!size) return;
  const bool is_on =
      mark.pixel.minCoeff() >= -1 && mark.pixel.x() <= size->x() && mark.pixel.y() <= size->y();
  if (is_on) return;
  throw ErrorAt(mark.place, "point \"" + mark.point + "\" is marked off photo \"" + mark.photo +
                                "\", which has " + std::to_string(size->x()) + " x " +
                                std::to_string(size->y()) +
                                " pixels; was it made on a photo of another size?");
}

std::vector<ImageObservation> MergeMarks(const std::vector<SurveyFile>& files,
                                         const std::vector<ControlPoint>& points,
                                         const std::set<std::string>& photos,
                                         const PhotoSize& photo_size,
                                         const SurveyImportOptions& options, LeftOut* left_out) {
  std::set<std::string> known;
  for (const ControlPoint& point : points) known.insert(point.name);
  const bool leaves_out = !known.empty() && !options.keeps_unsurveyed;
  std::map<std::pair<std::string, std::string>, ImageObservation> kept;
  std::vector<ImageObservation> marks;
  for (const SurveyFile& file : files) {
    for (const SurveyedMark& mark : file.marks) {
      const std::string photo = SitePhoto(mark.photo, options);
      if (!photos.contains(photo)) {
        left_out->photos.insert(photo);
        ++left_out->of_photos;
      } else if (leaves_out && !known.contains(mark.point)) {
        left_out->points.insert(mark.point);
        ++left_out->of_points;
      } else {
        CheckName(mark.point, mark.place);
        const ImageObservation ours{photo, mark.point, mark.pixel, SigmaOf(mark, options),
                                    mark.place};
        CheckOnFrame(ours, photo_size);
        if (!IsNew(kept, ours)) continue;
        kept.emplace(std::pair(photo, mark.point), ours);
        marks.push_back(ours);
      }
    }
  }
  return marks;
}

void ReportFile(const SurveyFile& file, std::vector<std::string>* report) {
  const std::string name = file.path.filename().string();
  std::string counts;
  const auto add = [&](size_t count, const std::string& what) {
    if (count) counts += (counts.empty() ? "" : ", ") + Counted(count, what);
  };
  add(file.points.size(), "point");
  add(file.centers.size(), "camera position");
  add(file.marks.size(), "mark");
  report->push_back(name + ": " + file.format + ", " + counts);
  const std::string prefix = name + ": ";
  for (const Sentence& remark : file.remarks) report->push_back(prefix + remark.text());
}

std::string DigitsOf(const Eigen::Vector3d& v) {
  return Digits(v.x()) + "," + Digits(v.y()) + "," + Digits(v.z());
}

std::string PointsTable(const std::vector<ControlPoint>& points) {
  std::string table = "name,x,y,z,sigma_x,sigma_y,sigma_z,role\n";
  for (const ControlPoint& point : points) {
    table += QuotedCell(point.name) + "," + DigitsOf(point.position) + "," + DigitsOf(point.sigma) +
             (point.role == ControlRole::kCheck ? ",check\n" : ",control\n");
  }
  return table;
}

std::string MarksTable(const std::vector<ImageObservation>& marks) {
  std::string table = "photo,point,x,y,sigma\n";
  for (const ImageObservation& mark : marks) {
    table += QuotedCell(mark.photo) + "," + QuotedCell(mark.point) + "," + Digits(mark.pixel.x()) +
             "," + Digits(mark.pixel.y()) + "," + Digits(mark.sigma_px) + "\n";
  }
  return table;
}

std::string CentersTable(const std::vector<CameraPosition>& centers) {
  std::string table = "photo,x,y,z,sigma_x,sigma_y,sigma_z,role\n";
  for (const CameraPosition& center : centers) {
    table += QuotedCell(center.photo) + "," + DigitsOf(center.position) + "," +
             DigitsOf(center.sigma) + ",weighted\n";
  }
  return table;
}

}  // namespace

void SurveyImportOptions::Check() const {
  INSITU_CHECK(!sigma_m || *sigma_m > 0);
  INSITU_CHECK(!mark_sigma_px || *mark_sigma_px > 0);
}

SurveyImport ImportSurvey(const std::vector<std::filesystem::path>& paths,
                          const std::set<std::string>& photos, const PhotoSize& photo_size,
                          const SurveyImportOptions& given) {
  given.Check();
  SurveyImportOptions options = given;
  SurveyImport import;
  std::vector<SurveyFile> files;
  for (const std::filesystem::path& path : paths) {
    files.push_back(ReadSurveyFile(path, photo_size, options.reading));
    ReportFile(files.back(), &import.report);
  }
  for (std::string& line : ConvertToOneSystem(options.file_crs, options.crs, &files)) {
    import.report.push_back(std::move(line));
  }
  options.photo_names.merge(NamesOfOtherCase(files, photos, &import.report));
  import.control_points = MergePoints(files, options);
  import.camera_positions = MergeCenters(files, photos, options);
  LeftOut left_out;
  import.observations =
      MergeMarks(files, import.control_points, photos, photo_size, options, &left_out);
  left_out.Report(&import.report);
  if (import.observations.empty() && left_out.of_photos > 0) {
    throw InputError(paths[0], "its marks are on photos that the site does not have (" +
                                   *left_out.photos.begin() +
                                   " ...); say which is which with --photo NAME=SITE_PHOTO");
  }
  return import;
}

SurveyImport ImportSurveyInto(const SitePaths& site,
                              const std::vector<std::filesystem::path>& files,
                              const SurveyImportOptions& options) {
  std::map<std::string, std::filesystem::path> photographs;
  std::set<std::string> photos;
  for (const std::filesystem::path& path : ListPhotographs(site)) {
    photographs[path.stem().string()] = path;
    photos.insert(path.stem().string());
  }
  std::map<std::string, Eigen::Vector2i> sizes;  // each photograph is opened once
  const PhotoSize photo_size = [&](const std::string& name) -> std::optional<Eigen::Vector2i> {
    const auto photograph = photographs.find(SitePhoto(name, options));
    if (photograph == photographs.end()) return std::nullopt;
    const auto known = sizes.find(photograph->first);
    if (known != sizes.end()) return known->second;
    return sizes[photograph->first] = ReadPhotographSize(photograph->second);
  };
  SurveyImport import = ImportSurvey(files, photos, photo_size, options);
  std::vector<std::pair<std::filesystem::path, std::string>> tables;
  if (!import.control_points.empty()) {
    tables.emplace_back(site.survey() / "control_points.csv", PointsTable(import.control_points));
  }
  if (!import.observations.empty()) {
    tables.emplace_back(site.survey() / "observations.csv", MarksTable(import.observations));
  }
  if (!import.camera_positions.empty()) {
    tables.emplace_back(site.survey() / "camera_positions.csv",
                        CentersTable(import.camera_positions));
  }
  for (const auto& [path, table] : tables) {
    if (std::filesystem::exists(path) && !options.may_replace) {
      throw InputError(path, "is there already; --replace writes it anew");
    }
  }
  for (const auto& [path, table] : tables) {
    WriteWhole(path, table);
    import.report.push_back("written: " + path.string());
  }
  return import;
}

}  // namespace insitu
