// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/field_survey.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "datasets_synthetic/ray_cast.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

constexpr double kFar = 60;  // [m], beyond it the photographs' base is too short

SurveyPoint Observe(const Site& site, const std::string& name, const Vector3d& position) {
  SurveyPoint point{name, position, {}, PointRole::kMarked};
  for (size_t i = 0; i < site.views.size(); ++i) {
    if (!Shows(site, site.views[i], position)) continue;
    point.marks.push_back({static_cast<int>(i), *Project(site.views[i], position)});
  }
  return point;
}

PointRole RoleOf(const Site& site, const SurveyPoint& point, bool is_target) {
  if (point.marks.size() < 2) return PointRole::kControl;
  if (site.survey.check_points.count(point.name)) return PointRole::kCheck;
  if (site.survey.control_points.count(point.name)) return PointRole::kControl;
  return is_target || point.position.norm() > kFar ? PointRole::kControl : PointRole::kMarked;
}

const SurveyPoint* FindPoint(const FieldSurvey& survey, const std::string& name) {
  const auto found = std::find_if(survey.points.begin(), survey.points.end(),
                                  [&](const SurveyPoint& point) { return point.name == name; });
  return found == survey.points.end() ? nullptr : &*found;
}

void AddVertices(const Site& site, FieldSurvey& survey) {
  for (const Face& face : site.natural.faces) {
    for (size_t i = 0; i < face.vertices.size(); ++i) {
      if (FindPoint(survey, face.vertex_names[i])) continue;
      survey.points.push_back(Observe(site, face.vertex_names[i], face.vertices[i]));
      survey.points.back().role = RoleOf(site, survey.points.back(), false);
    }
  }
  for (const auto& [name, position] : site.targets) {
    survey.points.push_back(Observe(site, name, position));
    survey.points.back().role = RoleOf(site, survey.points.back(), true);
  }
}

// Whether a shadow's corner lies here: some of the ring about the point is dark, most is lit.
bool IsShadowCorner(const Site& site, const Face& ground, const Vector3d& point) {
  constexpr int kRing = 48;
  constexpr double kRadius = 0.2;  // [m]
  int lit = 0;
  for (int i = 0; i < kRing; ++i) {
    const double turn = 2 * std::numbers::pi * (i + 0.5) / kRing;
    const Vector3d aside =
        kRadius * (std::cos(turn) * ground.u_axis + std::sin(turn) * ground.v_axis);
    lit += !IsBlocked(site.blockers, {point + aside, site.sun});
  }
  return lit > 0.55 * kRing && lit < 0.95 * kRing;
}

// Where a vertex throws its shadow on the ground, if it lies at a corner of the shadow.
std::optional<Vector3d> ShadowOnGround(const Site& site, const Vector3d& vertex) {
  const Ray ray{vertex - 0.01 * site.sun, -site.sun};
  const std::optional<Hit> hit = NearestHit(site.natural, ray);
  if (!hit || hit->face->name != site.survey.shadows) return std::nullopt;
  const Vector3d point = ray.origin + hit->distance * ray.direction;
  if (!IsShadowCorner(site, *hit->face, point)) return std::nullopt;
  return point;
}

void AddSunPairs(const Site& site, FieldSurvey& survey) {
  constexpr double kHigh = 2.5;  // [m], a long way to the shadow makes the direction sharp
  const std::vector<SurveyPoint> objects = survey.points;
  for (const SurveyPoint& object : objects) {
    if (object.position.dot(site.zenith) < kHigh || object.position.norm() > kFar) continue;
    const std::optional<Vector3d> shadow = ShadowOnGround(site, object.position);
    if (!shadow) continue;
    const SurveyPoint point = Observe(site, "sh_" + object.name, *shadow);
    if (point.marks.size() < 2) continue;
    survey.points.push_back(point);
    survey.sun_pairs.emplace_back(object.name, point.name);
  }
}

bool IsDetermined(const SurveyPoint& point) {
  return point.role == PointRole::kControl || point.marks.size() >= 2;
}

// Upright edges of boxes: corner i below, i + 4 above.
void AddZenithPairs(const Site& site, FieldSurvey& survey) {
  for (const std::string& box : site.survey.upright_boxes) {
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

bool Shows(const Site& site, const View& view, const Vector3d& point) {
  constexpr double kMargin = 2;       // [px]
  constexpr double kOwnFaces = 0.01;  // [m], faces that meet in the point do not hide it
  const auto pixel = Project(view, point);
  if (!pixel || pixel->minCoeff() < kMargin) return false;
  if (pixel->x() > view.lens.width - 1 - kMargin) return false;
  if (pixel->y() > view.lens.height - 1 - kMargin) return false;
  const Vector3d sight = point - view.center;
  const double distance = sight.norm();
  return !IsBlocked(site.natural, {view.center, sight / distance}, distance - kOwnFaces);
}

FieldSurvey SurveySite(const Site& site) {
  FieldSurvey survey;
  AddVertices(site, survey);
  if (site.has_sun) AddSunPairs(site, survey);
  AddZenithPairs(site, survey);
  return survey;
}

}  // namespace insitu::demo
