// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/questions.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <numbers>

#include "calibration/files/error_at.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/exchange/read_survey_file.h"
#include "reconstruction/geometry/best_photo.h"
#include "reconstruction/geometry/epipolar_curve.h"
#include "reconstruction/live/derived_quantity.h"
#include "reconstruction/live/one_ray.h"
#include "renderer/live/live_polygons.h"

namespace insitu {
namespace {

constexpr double kInDegrees = 180 / std::numbers::pi;
constexpr double kMarkSigma = 0.5;       // [px], of a mark that states none
constexpr double kCurve = 0.05;          // [px], of a polyline from the curve
constexpr double kSurveyedSigma = 0.01;  // [m], of pasted points that state none

SaidError NotKnown(const Sentence& what) { return ErrorAt({"question"}, what); }

std::vector<std::string> NamesIn(const Json::Value& list) {
  std::vector<std::string> names;
  for (const Json::Value& name : list) names.push_back(name.asString());
  return names;
}

Sentence NothingYet() { return Sentence("askedNothing", "nothing is adjusted yet"); }

const PosedCamera& CameraOf(const LiveState& live, const std::string& photo) {
  for (const PosedCamera& camera : live.result.cameras) {
    if (camera.photo == photo) return camera;
  }
  throw NotKnown(Sentence("askedPhoto", "photo {photo} is not oriented yet", {{"photo", photo}}));
}

Eigen::Vector3d PositionOf(const LiveState& live, const std::string& point) {
  const Json::Value& xyz = live.result.message["points"][point]["xyz"];
  if (xyz.size() != 3) {
    throw NotKnown(
        Sentence("askedPoint", "point {point} is not determined yet", {{"point", point}}));
  }
  return {xyz[0].asDouble(), xyz[1].asDouble(), xyz[2].asDouble()};
}

void RequireKnown(const std::optional<DerivedQuantity>& quantity) {
  if (quantity) return;
  throw NotKnown(
      Sentence("askedPoints", "not all of these points are adjusted, or two are in one place"));
}

}  // namespace

Json::Value EpipolarAnswer(const LiveState& live, const Json::Value& question) {
  const double sigma = question.get("sigma", kMarkSigma).asDouble();
  const SingleMark mark{question["photo"].asString(),
                        {question["x"].asDouble(), question["y"].asDouble()},
                        sigma > 0 ? sigma : kMarkSigma};
  const PosedCamera& other = CameraOf(live, question["other"].asString());
  const std::vector<Polyline> pieces =
      EpipolarCurve(CameraOf(live, mark.photo), mark.pixel, other, kCurve);
  Json::Value answer;
  answer["curve"] = answer["band"] = Json::Value(Json::arrayValue);
  const auto longest =
      std::max_element(pieces.begin(), pieces.end(),
                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (longest == pieces.end()) return answer;
  for (const Eigen::Vector2d& at : *longest) answer["curve"].append(ToJson(Eigen::VectorXd(at)));
  for (const Eigen::Vector2d& across :
       EpipolarBand(*live.result.solved, mark, other.photo, *longest)) {
    answer["band"].append(ToJson(Eigen::VectorXd(across)));
  }
  return answer;
}

Json::Value MeasureAnswer(const LiveState& live, const Json::Value& question) {
  const std::vector<std::string> points = NamesIn(question["points"]);
  if (!live.result.solved) throw NotKnown(NothingYet());
  Json::Value answer;
  if (points.size() == 2) {
    const auto distance = AdjustedDistance(*live.result.solved, points[0], points[1]);
    const auto height = AdjustedHeight(*live.result.solved, points[0], points[1]);
    RequireKnown(distance);
    RequireKnown(height);
    answer["distance_m"] = distance->value;
    answer["sigma_m"] = distance->sigma;
    answer["height_m"] = height->value;
    answer["height_sigma_m"] = height->sigma;
  } else if (points.size() == 3) {
    const auto angle = AdjustedAngle(*live.result.solved, points[0], points[1], points[2]);
    RequireKnown(angle);
    answer["angle_deg"] = angle->value * kInDegrees;
    answer["sigma_deg"] = angle->sigma * kInDegrees;
  } else {
    throw NotKnown(Sentence("askedTwo", "expected two points, or three for an angle"));
  }
  return answer;
}

Json::Value BestPhotoAnswer(const LiveState& live, const Json::Value& question) {
  std::vector<Eigen::Vector3d> vertices;
  for (const std::string& name : NamesIn(question["vertices"])) {
    vertices.push_back(PositionOf(live, name));
  }
  if (vertices.size() < 3)
    throw NotKnown(Sentence("askedThree", "expected three vertices or more"));
  Json::Value answer;
  answer["photos"] = Json::Value(Json::arrayValue);
  for (const PhotoOfPolygon& photo : RankPhotosOf(live.result.cameras, vertices)) {
    Json::Value json;
    json["photo"] = live.result.cameras[photo.photo].photo;
    json["score"] = photo.score;
    json["angle_deg"] = photo.angle * kInDegrees;
    json["mm_per_px"] = photo.mm_per_px;
    answer["photos"].append(json);
  }
  return answer;
}

Json::Value PolygonAtAnswer(const LiveState& live, const Json::Value& question) {
  const PosedCamera& camera = CameraOf(live, question["photo"].asString());
  if (!live.result.scene) throw NotKnown(NothingYet());
  const std::vector<Polygon>& polygons = live.result.scene->polygons;
  const auto seen =
      PolygonSeenAt(polygons, camera, {question["x"].asDouble(), question["y"].asDouble()});
  Json::Value answer;
  answer["polygon"] = seen ? Json::Value(polygons[*seen].name) : Json::Value();
  return answer;
}

Json::Value ImportAnswer(const SitePaths& site, const Json::Value& question) {
  static std::mutex one_at_a_time;  // windows that paste share the file
  const std::lock_guard lock(one_at_a_time);
  const std::filesystem::path pasted = site.root / "work/prepare/pasted.txt";
  WriteWhole(pasted, question["text"].asString());
  const SurveyFile file = ReadSurveyFile(pasted, [](const std::string&) { return std::nullopt; });
  Json::Value answer;
  answer["format"] = file.format;
  answer["rows"] = answer["remarks"] = Json::Value(Json::arrayValue);
  for (const Sentence& remark : file.remarks) answer["remarks"].append(remark.ToJson());
  if (file.has_degrees) {
    throw ErrorAt({pasted}, Sentence("pastedDegrees",
                                     "these are degrees: use insitu import-survey, which converts "
                                     "them"));
  }
  if (file.crs) {
    answer["remarks"].append(
        Sentence("pastedCrs", "coordinate system {crs}: taken as it stands", {{"crs", *file.crs}})
            .ToJson());
  }
  for (const SurveyedPoint& point : file.points) {
    const Eigen::Vector3d sigma = point.sigma.value_or(Eigen::Vector3d::Constant(kSurveyedSigma));
    Json::Value row;
    row["name"] = point.name;
    row["role"] = point.role == ControlRole::kCheck ? "check" : "control";
    const char* const axes[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      row[axes[i]] = point.position[i];
      row[std::string("sigma_") + axes[i]] = sigma[i];
    }
    answer["rows"].append(row);
  }
  const bool has_guessed = std::any_of(file.points.begin(), file.points.end(),
                                       [](const SurveyedPoint& point) { return !point.sigma; });
  if (has_guessed) {
    answer["remarks"].append(
        Sentence("pastedSigma", "no sigma is stated: taken as 0.01 m").ToJson());
  }
  return answer;
}

}  // namespace insitu
