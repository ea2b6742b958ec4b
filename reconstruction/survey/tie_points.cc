// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/tie_points.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr char kFormat[] = "insitu tie points";
constexpr int kVersion = 1;
constexpr char kNameStart[] = "tie_";

Json::Value PhotosJson(const TiePoints& tie_points) {
  Json::Value photos(Json::arrayValue);
  for (const auto& [name, cam_from_model] : tie_points.cam_from_model) {
    Json::Value photo;
    photo["name"] = name;
    photo["rotation_wxyz"] = ToJson(
        Eigen::VectorXd(Eigen::Vector4d(cam_from_model.rotation.w(), cam_from_model.rotation.x(),
                                        cam_from_model.rotation.y(), cam_from_model.rotation.z())));
    photo["translation"] = ToJson(Eigen::VectorXd(cam_from_model.translation));
    photos.append(photo);
  }
  return photos;
}

// x, y, z, then photo, x, y of each mark; a photo by its place in the list of photos.
Json::Value PointsJson(const TiePoints& tie_points) {
  std::map<std::string, int> index_of_photo;
  for (const auto& [name, pose] : tie_points.cam_from_model) {
    index_of_photo.emplace(name, static_cast<int>(index_of_photo.size()));
  }
  Json::Value points(Json::arrayValue);
  for (const TiePoint& point : tie_points.points) {
    Json::Value row = ToJson(Eigen::VectorXd(point.position));
    for (const TiePointMark& mark : point.marks) {
      row.append(index_of_photo.at(mark.photo));
      row.append(mark.pixel.x());
      row.append(mark.pixel.y());
    }
    points.append(row);
  }
  return points;
}

Json::Value TextsJson(const std::vector<std::string>& texts) {
  Json::Value json(Json::arrayValue);
  for (const std::string& text : texts) json.append(text);
  return json;
}

Rigid3 PoseOf(const JsonNode& photo) {
  const std::vector<double> wxyz = photo.At("rotation_wxyz").Numbers();
  if (wxyz.size() != 4) throw photo.Error("expected the four numbers of a quaternion");
  const Eigen::Quaterniond rotation(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(rotation.norm() > 0)) throw photo.Error("its quaternion is 0, expected a rotation");
  return {rotation.normalized(), photo.At("translation").Vector3()};
}

TiePoint PointOf(const JsonNode& node, const std::vector<std::string>& photos) {
  const std::vector<double> row = node.Numbers();
  if (row.size() < 9 || row.size() % 3 != 0) {
    throw node.Error("expected x, y, z, then photo, x, y of two or more marks");
  }
  TiePoint point{{row[0], row[1], row[2]}, {}};
  std::set<size_t> seen;
  for (size_t i = 3; i < row.size(); i += 3) {
    const bool is_place =
        row[i] >= 0 && row[i] < static_cast<double>(photos.size()) && row[i] == std::floor(row[i]);
    if (!is_place || !seen.insert(static_cast<size_t>(row[i])).second) {
      throw node.Error("expected marks on two or more placed photos, one on each");
    }
    point.marks.push_back({photos[static_cast<size_t>(row[i])], {row[i + 1], row[i + 2]}});
  }
  return point;
}

}  // namespace

std::string TiePointName(size_t index) { return Formatted("%s%06zu", kNameStart, index + 1); }

bool IsTiePointName(const std::string& name) {
  const size_t start = sizeof kNameStart - 1;
  return name.starts_with(kNameStart) && name.size() >= start + 6 &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(start), name.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

void WriteTiePoints(const SitePaths& site, const TiePoints& tie_points) {
  Json::Value root;
  root["format"] = kFormat;
  root["version"] = kVersion;
  root["program"] = tie_points.program;
  root["program_version"] = tie_points.program_version;
  root["sigma_px"] = tie_points.sigma_px;
  root["photos"] = PhotosJson(tie_points);
  root["points"] = PointsJson(tie_points);
  root["not_placed"] = TextsJson(tie_points.not_placed);
  root["remarks"] = TextsJson(tie_points.remarks);
  WriteJson(site.tie_points(), root);
}

std::optional<TiePoints> ReadTiePoints(const SitePaths& site) {
  if (!std::filesystem::exists(site.tie_points())) return std::nullopt;
  const JsonNode root = JsonNode::Load(site.tie_points());
  if (root.At("format").Text() != kFormat || root.At("version").Integer() != kVersion) {
    throw root.Error(std::string("expected '") + kFormat + "', version " +
                     std::to_string(kVersion) + ": run insitu-tie-points again");
  }
  TiePoints tie_points;
  if (const auto program = root.Find("program")) tie_points.program = program->Text();
  if (const auto version = root.Find("program_version")) {
    tie_points.program_version = version->Text();
  }
  tie_points.sigma_px = root.At("sigma_px").Number();
  if (!(tie_points.sigma_px > 0)) throw root.At("sigma_px").Error("expected more than 0");
  std::vector<std::string> photos;
  for (const JsonNode& photo : root.At("photos").Items()) {
    photos.push_back(photo.At("name").Text());
    tie_points.cam_from_model[photos.back()] = PoseOf(photo);
  }
  for (const JsonNode& point : root.At("points").Items()) {
    tie_points.points.push_back(PointOf(point, photos));
  }
  tie_points.not_placed = root.At("not_placed").Texts();
  tie_points.remarks = root.At("remarks").Texts();
  return tie_points;
}

}  // namespace insitu
