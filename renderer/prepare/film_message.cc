// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/film_message.h"

#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "calibration/camera_files/film.h"
#include "calibration/camera_files/film_review.h"
#include "calibration/camera_files/read_camera_file.h"
#include "calibration/files/error.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using MarksOfPhotos = std::map<std::string, std::vector<Fiducial>>;
using CertifiedFiducials = std::map<std::string, Eigen::Vector2d>;

bool IsOwnCamera(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.starts_with("board_")) return IsPhotograph(file);
  return name == "camera.cameramodel" || (IsCameraFile(file) && SpeaksOfCamera(file));
}

bool HasOtherFolders(const fs::path& film) {
  for (const auto& entry : fs::directory_iterator(film.parent_path())) {
    if (entry.is_directory() && entry.path() != film) return true;
  }
  return false;
}

Eigen::Vector2d Millimetres(const Json::Value& row) {
  return {row["x_mm"].asDouble(), row["y_mm"].asDouble()};
}

// Switched off: in the file a comment, which no program reads.
bool IsMarkOff(const Json::Value& row) { return row["state"] == "off"; }

Json::Value NumberOrNull(const std::optional<double>& number) {
  return number ? Json::Value(*number) : Json::Value();
}

class Message {
 public:
  Message(const SitePaths& site, const Json::Value& tables,
          const std::map<std::string, Eigen::Vector2i>& sizes)
      : site_(site), tables_(tables), sizes_(sizes), folder_(FilmFolder(site.boards())) {}

  Json::Value Make() {
    message_["type"] = "film";
    message_["folder"] = folder_.lexically_relative(site_.root).string();
    for (const char* list : {"missing", "faults"}) message_[list] = Json::Value(Json::arrayValue);
    message_["photos"] = Json::Value(Json::objectValue);
    TakeCertificate();
    TakeMarks();
    Files();
    Folders();
    for (const auto& [photo, marks] : marks_) TellPhoto(photo, marks);
    return std::move(message_);
  }

 private:
  void Fault(const Sentence& sentence) { message_["faults"].append(sentence.ToJson()); }
  void Miss(const Sentence& sentence) { message_["missing"].append(sentence.ToJson()); }

  void TakeCertificate() {
    const Json::Value& film = tables_["film"][0];
    if (film["transformation"] == "projective") transformation_ = FilmTransformation::kProjective;
    for (const Json::Value& row : tables_["film_marks"]) {
      if (!row["x_mm"].isNumeric() || !row["y_mm"].isNumeric()) continue;  // the reader says it
      if (certified_.emplace(row["mark"].asString(), Millimetres(row)).second) continue;
      Fault(Sentence("filmListedTwice", "the certificate lists mark {mark} twice",
                     {{"mark", row["mark"]}}));
    }
    is_listed_ = !certified_.empty();
    for (const Json::Value& row : tables_["fiducials"]) {
      if (IsMarkOff(row)) continue;
      certified_.emplace(row["mark"].asString(), Millimetres(row));
    }
    const int needed = transformation_ == FilmTransformation::kAffine ? 3 : 4;
    const int lacking = needed - static_cast<int>(certified_.size());
    if (!film["focal_mm"].isNumeric()) Miss(Sentence("filmNoFocal", "the principal distance"));
    if (lacking <= 0) return;
    Miss(Sentence("filmNoMarks", "{count} more fiducial marks with their millimetres",
                  {{"count", lacking}}));
  }

  void TakeMarks() {
    if (!is_listed_ && tables_["fiducials"].empty() && tables_["film"].empty()) return;
    if (folder_ == site_.boards() || !HasOtherFolders(folder_)) {
      for (const auto& [photo, size] : sizes_) marks_[photo];
    }
    for (const Json::Value& row : tables_["fiducials"]) {
      const std::string mark = row["mark"].asString(), photo = row["photo"].asString();
      std::vector<Fiducial>& marks = marks_[photo];  // known as a scan, be all its marks off
      if (IsMarkOff(row)) {
        off_[photo].insert(mark);
        continue;
      }
      if (is_listed_ && Millimetres(row) != certified_.at(mark)) {
        Fault(Sentence("filmOtherMillimetres",
                       "mark {mark} of {photo} has other millimetres than the certificate",
                       {{"mark", mark}, {"photo", photo}}));
      }
      const double sigma_times = row["state"] == "dubious" ? kDubiousFiducial : 1;
      marks.push_back(
          {mark, Millimetres(row), {row["x"].asDouble(), row["y"].asDouble()}, sigma_times});
    }
  }

  // What the programs' readers object to in the files as they are.
  void Files() {
    const fs::path film = folder_ / "film.json", fiducials = folder_ / "fiducials.csv";
    try {
      if (tables_["film"][0]["focal_mm"].isNumeric() && fs::exists(film)) ReadFilmCamera(film);
      if (fs::exists(fiducials)) ReadFiducials(fiducials);
    } catch (const InputError& error) {
      Fault(SentenceOf(error));
    }
  }

  void Folders() {
    if (FilmFolders(site_.boards()).size() > 1) {
      Fault(Sentence("filmFolders",
                     "several folders of calibration/ hold film; this page shows that in {folder}",
                     {{"folder", message_["folder"]}}));
    }
    const Sentence refusal = RefusalOfFilm(site_);
    if (!refusal.empty()) Fault(refusal);
  }

  void TellPhoto(const std::string& photo, const std::vector<Fiducial>& marks) {
    const auto size = sizes_.find(photo);
    if (size == sizes_.end()) {
      return Fault(
          Sentence("filmNoPhoto", "photo {photo} is not in the folder photos", {{"photo", photo}}));
    }
    const ScanReview review = ReviewScan(marks, certified_, transformation_, size->second);
    Json::Value& told = message_["photos"][photo];
    told["needed"] = review.needed;
    told["placed"] = static_cast<int>(marks.size());
    told["usable"] = review.is_usable;
    told["kind"] = transformation_ == FilmTransformation::kAffine ? "affine" : "projective";
    told["unplaced"] = Unplaced(photo, marks);
    told["suspicions"] = told["marks"] = Json::Value(Json::arrayValue);
    for (const Sentence& each : review.suspicions) told["suspicions"].append(each.ToJson());
    told["predicted"] = Json::Value(Json::objectValue);
    for (const auto& [mark, pixel] : review.predicted) {
      for (const double value : pixel) told["predicted"][mark].append(value);
    }
    TellMap(review, told);
  }

  Json::Value Unplaced(const std::string& photo, const std::vector<Fiducial>& marks) const {
    Json::Value names(Json::arrayValue);
    CertifiedFiducials left = certified_;
    for (const Fiducial& mark : marks) left.erase(mark.mark);
    if (const auto off = off_.find(photo); off != off_.end()) {
      for (const std::string& mark : off->second) left.erase(mark);
    }
    for (const auto& [mark, image_mm] : left) names.append(mark);
    return names;
  }

  static void TellMap(const ScanReview& review, Json::Value& told) {
    told["redundancy"] = review.redundancy;
    for (const char* number : {"sigma_px", "sigma_mm", "px_per_mm", "turn_deg"}) told[number];
    if (!review.map) return;
    told["px_per_mm"] = review.px_per_mm;
    told["turn_deg"] = review.turn_deg;
    if (review.map->sigma_px) {
      told["sigma_px"] = *review.map->sigma_px;
      told["sigma_mm"] = *review.map->sigma_px / review.px_per_mm;
    }
    for (const FiducialReview& mark : review.marks) told["marks"].append(MarkJson(mark));
  }

  static Json::Value MarkJson(const FiducialReview& mark) {
    Json::Value json;
    json["mark"] = mark.mark;
    json["vx"] = mark.residual_px.x();
    json["vy"] = mark.residual_px.y();
    json["vx_mm"] = mark.residual_mm.x();
    json["vy_mm"] = mark.residual_mm.y();
    json["r"] = mark.redundancy;
    json["w"] = NumberOrNull(mark.w);
    json["off_px"] = NumberOrNull(mark.off_px);
    return json;
  }

  const SitePaths& site_;
  const Json::Value& tables_;
  const std::map<std::string, Eigen::Vector2i>& sizes_;
  const fs::path folder_;
  FilmTransformation transformation_ = FilmTransformation::kAffine;
  CertifiedFiducials certified_;                      // of the certificate, else as placed
  bool is_listed_ = false;                            // the certificate lists them
  MarksOfPhotos marks_;                               // those that are on
  std::map<std::string, std::set<std::string>> off_;  // by photo
  Json::Value message_;
};

}  // namespace

bool IsOfFilm(const std::string& table) {
  return table == "film" || table == "film_marks" || table == "fiducials";
}

Sentence RefusalOfFilm(const SitePaths& site) {
  const fs::path folder = FilmFolder(site.boards());
  if (!fs::is_directory(folder)) return {};
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || !IsOwnCamera(entry.path())) continue;
    return Sentence(
        "filmOtherCamera",
        "{file} is of another camera: remove it, or move it into a folder of calibration/ and "
        "start insitu prepare again; film then has the folder calibration/film/",
        {{"file", entry.path().lexically_relative(site.root).string()}});
  }
  return {};
}

Json::Value FilmMessage(const SitePaths& site, const Json::Value& tables,
                        const std::map<std::string, Eigen::Vector2i>& sizes) {
  if (tables["film"].empty() && tables["film_marks"].empty() && tables["fiducials"].empty()) {
    return Json::Value();
  }
  return Message(site, tables, sizes).Make();
}

}  // namespace insitu
