// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace insitu {
namespace {

constexpr double kCriticalTestValue = 3.29;  // two-sided, 0.1 %
constexpr double kSignificance = 0.05;       // of the global test
constexpr double kSmallAngle = 5 * M_PI / 180;
constexpr double kCheckLimit = 1.5;  // root mean square over combined sigma; twice that fails

std::string Number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// "points with rays within 5 degrees (2): a, b"; at most eight names.
Objection Listing(const std::string& what, const std::vector<std::string>& names) {
  constexpr size_t kShown = 8;
  std::string text = what + " (" + std::to_string(names.size()) + "): ";
  for (size_t i = 0; i < std::min(names.size(), kShown); ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return {Severity::kReview, text};
}

void JudgeGlobalTest(const Adjustment& adjustment, std::vector<Objection>* objections) {
  if (adjustment.redundancy == 0) {
    objections->push_back({Severity::kReview, "no redundancy: errors cannot be found"});
  } else if (adjustment.chi_square_p < kSignificance) {
    const bool is_worse = adjustment.sigma0 > 1;
    const bool is_far = adjustment.sigma0 > 2;
    objections->push_back(
        {is_far ? Severity::kFail : Severity::kReview,
         "the global test is not met: sigma0 " + Number("%.2f", adjustment.sigma0) + ", p " +
             Number("%.4f", adjustment.chi_square_p) +
             (is_worse ? "; the observations are worse than their sigmas say, or one is wrong"
                       : "; the observations are better than their sigmas say")});
  }
}

void JudgeObservations(const Adjustment& adjustment, std::vector<Objection>* objections) {
  std::vector<std::pair<double, std::string>> flagged;
  for (const ObservationResidual& row : adjustment.residuals) {
    const double w = std::abs(TestValue(row).value_or(0));
    if (w <= kCriticalTestValue) continue;
    const std::string where = row.photo.empty() ? row.group : row.photo + " " + row.group;
    flagged.emplace_back(-w, row.subject + " (" + where + ", w " + Number("%.1f", w) + ")");
  }
  if (flagged.empty()) return;
  std::sort(flagged.begin(), flagged.end());
  std::vector<std::string> names;
  for (const auto& [minus_w, name] : flagged) names.push_back(name);
  objections->push_back(Listing("observations with a test value over 3.29", names));
}

// Control points are determined by the survey; only the others depend on their rays.
void JudgeRays(const Adjustment& adjustment, const Survey& survey,
               std::vector<Objection>* objections) {
  std::set<std::string> controlled;
  for (const PointComparison& point : adjustment.control) controlled.insert(point.name);
  const std::map<std::string, double> angles = LargestRayAngles(adjustment, survey);
  std::vector<std::string> few, narrow;
  for (const AdjustedPoint& point : adjustment.points) {
    if (controlled.contains(point.name)) continue;
    const auto angle = angles.find(point.name);
    if (point.rays < 2) few.push_back(point.name);
    if (angle != angles.end() && angle->second < kSmallAngle) narrow.push_back(point.name);
  }
  if (!few.empty()) {
    objections->push_back(Listing("points on fewer than two photos, held by polygons alone", few));
  }
  if (!narrow.empty()) objections->push_back(Listing("points with rays within 5 degrees", narrow));
}

void JudgeCheckPoints(const Adjustment& adjustment, std::vector<Objection>* objections) {
  if (adjustment.check.empty()) {
    objections->push_back({Severity::kReview, "no check points: accuracy not verified"});
  } else if (adjustment.check_rms_over_sigma > kCheckLimit) {
    objections->push_back(
        {adjustment.check_rms_over_sigma > 2 * kCheckLimit ? Severity::kFail : Severity::kReview,
         "the check points differ by " + Number("%.2f", adjustment.check_rms_over_sigma) +
             " times their combined sigma"});
  }
}

}  // namespace

std::optional<double> TestValue(const ObservationResidual& row) {
  if (row.redundancy < 1e-6) return std::nullopt;
  return row.residual / (row.sigma * std::sqrt(row.redundancy));
}

std::map<std::string, double> LargestRayAngles(const Adjustment& adjustment, const Survey& survey) {
  std::map<std::string, Eigen::Vector3d> center_of_photo, position_of_point;
  for (const AdjustedPose& pose : adjustment.poses) {
    center_of_photo[pose.photo] = Center(pose.cam_from_world);
  }
  for (const AdjustedPoint& point : adjustment.points) {
    position_of_point[point.name] = point.position;
  }
  std::map<std::string, std::vector<Eigen::Vector3d>> rays;
  std::map<std::string, double> angles;
  for (const ImageObservation& mark : survey.observations) {
    const Eigen::Vector3d ray = position_of_point.at(mark.point) - center_of_photo.at(mark.photo);
    for (const Eigen::Vector3d& other : rays[mark.point]) {
      const double angle = std::atan2(ray.cross(other).norm(), ray.dot(other));
      double& largest = angles[mark.point];
      largest = std::max(largest, angle);
    }
    rays[mark.point].push_back(ray);
  }
  return angles;
}

std::vector<Objection> Judge(const Adjustment& adjustment, const Survey& survey) {
  std::vector<Objection> objections;
  JudgeGlobalTest(adjustment, &objections);
  JudgeObservations(adjustment, &objections);
  JudgeCheckPoints(adjustment, &objections);
  JudgeRays(adjustment, survey, &objections);
  for (const std::string& warning : adjustment.warnings) {
    objections.push_back({Severity::kReview, warning});
  }
  return objections;
}

Json::Value VerdictReport(std::vector<Objection> objections) {
  std::stable_sort(objections.begin(), objections.end(),
                   [](const auto& a, const auto& b) { return a.severity > b.severity; });
  const Severity worst = objections.empty() ? Severity::kPass : objections.front().severity;
  Json::Value json;
  json["status"] = worst == Severity::kPass     ? "pass"
                   : worst == Severity::kReview ? "review"
                                                : "fail";
  json["reasons"] = Json::Value(Json::arrayValue);
  for (const Objection& objection : objections) json["reasons"].append(objection.reason);
  return json;
}

}  // namespace insitu
