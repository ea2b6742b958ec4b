// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/field_survey.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "datasets_synthetic/ray_cast.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

constexpr double kFar = 60;  // [m], beyond it the photographs' base is too short

const std::set<std::string>& CheckPoints() {
  static const std::set<std::string> names = {"roof_1",  "roof_7",        "sup10_4",
                                              "sup21_1", "house_ridge_1", "path_6"};
  return names;
}

SurveyPoint Observe(const Campus& campus, const std::string& name, const Vector3d& position) {
  SurveyPoint point{name, position, {}, PointRole::kMarked};
  for (size_t i = 0; i < campus.views.size(); ++i) {
    if (!Shows(campus, campus.views[i], position)) continue;
    point.marks.push_back({static_cast<int>(i), *Project(campus.views[i], position)});
  }
  return point;
}

PointRole RoleOf(const SurveyPoint& point, bool is_target) {
  if (point.marks.size() < 2) return PointRole::kControl;
  if (CheckPoints().count(point.name)) return PointRole::kCheck;
  return is_target || point.position.norm() > kFar ? PointRole::kControl : PointRole::kMarked;
}

const SurveyPoint* FindPoint(const FieldSurvey& survey, const std::string& name) {
  const auto found = std::find_if(survey.points.begin(), survey.points.end(),
                                  [&](const SurveyPoint& point) { return point.name == name; });
  return found == survey.points.end() ? nullptr : &*found;
}

void AddVertices(const Campus& campus, FieldSurvey& survey) {
  for (const Face& face : campus.natural.faces) {
    for (size_t i = 0; i < face.vertices.size(); ++i) {
      if (FindPoint(survey, face.vertex_names[i])) continue;
      survey.points.push_back(Observe(campus, face.vertex_names[i], face.vertices[i]));
      survey.points.back().role = RoleOf(survey.points.back(), false);
    }
  }
  for (const auto& [name, position] : campus.targets) {
    survey.points.push_back(Observe(campus, name, position));
    survey.points.back().role = RoleOf(survey.points.back(), true);
  }
}

// Whether a shadow's corner lies here: some of the ring about the point is dark, most is lit.
bool IsShadowCorner(const Campus& campus, const Face& ground, const Vector3d& point) {
  constexpr int kRing = 48;
  constexpr double kRadius = 0.2;  // [m]
  int lit = 0;
  for (int i = 0; i < kRing; ++i) {
    const double turn = 2 * std::numbers::pi * (i + 0.5) / kRing;
    const Vector3d aside =
        kRadius * (std::cos(turn) * ground.u_axis + std::sin(turn) * ground.v_axis);
    lit += !IsBlocked(campus.blockers, {point + aside, campus.sun});
  }
  return lit > 0.55 * kRing && lit < 0.95 * kRing;
}

// Where a vertex throws its shadow on the lawn, if it lies at a corner of the shadow.
std::optional<Vector3d> ShadowOnLawn(const Campus& campus, const Vector3d& vertex) {
  const Ray ray{vertex - 0.01 * campus.sun, -campus.sun};
  const std::optional<Hit> hit = NearestHit(campus.natural, ray);
  if (!hit || hit->face->name != "lawn") return std::nullopt;
  const Vector3d point = ray.origin + hit->distance * ray.direction;
  if (!IsShadowCorner(campus, *hit->face, point)) return std::nullopt;
  return point;
}

void AddSunPairs(const Campus& campus, FieldSurvey& survey) {
  constexpr double kHigh = 2.5;  // [m], a long way to the shadow makes the direction sharp
  const std::vector<SurveyPoint> objects = survey.points;
  for (const SurveyPoint& object : objects) {
    if (object.position.dot(campus.zenith) < kHigh || object.position.norm() > kFar) continue;
    const std::optional<Vector3d> shadow = ShadowOnLawn(campus, object.position);
    if (!shadow) continue;
    const SurveyPoint point = Observe(campus, "sh_" + object.name, *shadow);
    if (point.marks.size() < 2) continue;
    survey.points.push_back(point);
    survey.sun_pairs.emplace_back(object.name, point.name);
  }
}

bool IsDetermined(const SurveyPoint& point) {
  return point.role == PointRole::kControl || point.marks.size() >= 2;
}

// Upright edges of boxes: corner i below, i + 4 above.
void AddZenithPairs(FieldSurvey& survey) {
  for (const std::string box : {"lamp", "house", "block", "tower", "sup00", "sup10", "sup20"}) {
    for (int i = 0; i < 4; ++i) {
      const SurveyPoint* bottom = FindPoint(survey, box + "_" + std::to_string(i));
      const SurveyPoint* top = FindPoint(survey, box + "_" + std::to_string(i + 4));
      if (!bottom || !top || !IsDetermined(*bottom) || !IsDetermined(*top)) continue;
      if (bottom->marks.empty() || top->marks.empty()) continue;
      survey.zenith_pairs.emplace_back(bottom->name, top->name);
    }
  }
}

}  // namespace

bool Shows(const Campus& campus, const View& view, const Vector3d& point) {
  constexpr double kMargin = 2;       // [px]
  constexpr double kOwnFaces = 0.01;  // [m], faces that meet in the point do not hide it
  const auto pixel = Project(view, point);
  if (!pixel || pixel->minCoeff() < kMargin) return false;
  if (pixel->x() > view.lens.width - 1 - kMargin) return false;
  if (pixel->y() > view.lens.height - 1 - kMargin) return false;
  const Vector3d sight = point - view.center;
  const double distance = sight.norm();
  return !IsBlocked(campus.natural, {view.center, sight / distance}, distance - kOwnFaces);
}

FieldSurvey SurveyCampus(const Campus& campus) {
  FieldSurvey survey;
  AddVertices(campus, survey);
  AddSunPairs(campus, survey);
  AddZenithPairs(survey);
  return survey;
}

}  // namespace insitu::demo
