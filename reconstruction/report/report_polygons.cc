// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/report_polygons.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/json_file.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "reconstruction/report/polygon_measures.h"

namespace insitu {
namespace {

constexpr double kNearlySquare = 10 * kDegree, kNearlyLevel = 22.5 * kDegree;

// mm/m of a small angle and of its sigma.
Json::Value Slope(const UncertainValue& angle) {
  Json::Value json;
  json["mm_per_m"] = 1000 * std::tan(angle.value);
  json["sigma_mm_per_m"] = 1000 * angle.sigma;
  return json;
}

Json::Value Length(const UncertainValue& length) {
  Json::Value json;
  json["m"] = length.value;
  json["sigma_m"] = length.sigma;
  return json;
}

// By polygon and vertex.
using PlaneRows = std::map<std::pair<std::string, std::string>, const ObservationResidual*>;

Json::Value Vertices(const PolygonOutline& outline, const PlaneRows& rows, double sigma0) {
  Json::Value json(Json::arrayValue);
  const auto add = [&](const std::string& name, int hole) {
    Json::Value vertex;
    vertex["name"] = name;
    if (hole > 0) vertex["hole"] = hole;
    for (const char* key : {"off_plane_mm", "off_plane_sigma_mm", "w"}) vertex[key] = Json::Value();
    const auto found = rows.find({outline.name, name});
    if (found != rows.end()) {
      const ObservationResidual& row = *found->second;
      // Of the adjusted distance: the a priori variance less the residual's.
      const double share = std::max(0.0, 1 - row.redundancy);
      vertex["off_plane_mm"] = 1000 * row.residual;
      vertex["off_plane_sigma_mm"] = 1000 * sigma0 * row.sigma * std::sqrt(share);
      if (row.w) vertex["w"] = *row.w;
    }
    json.append(vertex);
  };
  for (const std::string& name : outline.vertices) add(name, 0);
  int hole = 0;
  for (const auto& ring : outline.holes) {
    ++hole;
    for (const std::string& name : ring) add(name, hole);
  }
  return json;
}

Json::Value PlaneReport(const AdjustedPlane& plane, const Direction& zenith) {
  Json::Value json;
  json["plane_sigma_m"] = plane.vertex_sigma;
  json["normal_covariance"] = ToJson(Eigen::MatrixXd(plane.normal_covariance));
  json["centroid"] = ToJson(Eigen::VectorXd(plane.centroid));
  json["offset_m"] = plane.offset;
  json["offset_sigma_m"] = plane.offset_sigma;
  json["planarity_rms_mm"] = 1000 * plane.planarity_rms;
  if (plane.off_vertical) {
    json["verticality"] = Slope({*plane.off_vertical, plane.off_vertical_sigma.value_or(0)});
  }
  const UncertainValue off_level = OffLevel(plane, zenith.unit);
  if (std::abs(off_level.value) < kNearlyLevel) json["levelness"] = Slope(off_level);
  return json;
}

Json::Value OutlineReport(const PolygonOutline& outline, const PolygonMeasures& measures) {
  Json::Value json;
  json["area"]["m2"] = measures.area.value;
  json["area"]["sigma_m2"] = measures.area.sigma;
  json["sigma_basis"] =
      measures.is_joint ? "joint covariance of the vertices" : "vertices taken as independent";
  json["edges"] = Json::Value(Json::arrayValue);
  const auto add = [&](const std::vector<std::string>& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      Json::Value edge = Length(measures.edges[json["edges"].size()]);
      edge["from"] = ring[i];
      edge["to"] = ring[(i + 1) % ring.size()];
      json["edges"].append(edge);
    }
  };
  add(outline.vertices);
  for (const auto& hole : outline.holes) add(hole);
  json["holes"] = static_cast<Json::UInt64>(outline.holes.size());
  return json;
}

void Merge(const Json::Value& from, Json::Value* to) {
  for (const std::string& key : from.getMemberNames()) (*to)[key] = from[key];
}

const AdjustedPlane* FindPlane(const Adjustment& adjustment, const std::string& polygon) {
  for (const AdjustedPlane& plane : adjustment.planes) {
    if (plane.polygon == polygon) return &plane;
  }
  return nullptr;
}

Json::Value DirectionReport(const Direction& direction, size_t pairs) {
  const double largest_variance = EigenOfSymmetric(direction.covariance).values[2];
  const Eigen::Vector3d& unit = direction.unit;
  Json::Value json;
  json["unit"] = ToJson(Eigen::VectorXd(unit));
  json["covariance"] = ToJson(Eigen::MatrixXd(direction.covariance));
  json["azimuth_deg"] = std::atan2(unit.x(), unit.y()) / kDegree;
  json["elevation_deg"] = std::asin(std::clamp(unit.z(), -1.0, 1.0)) / kDegree;
  json["pairs"] = static_cast<Json::UInt64>(pairs);
  json["sigma_deg"] = std::sqrt(std::max(largest_variance, 0.0)) / kDegree;
  return json;
}

}  // namespace

Json::Value PolygonsSection(const Adjustment& adjustment, const Survey& survey) {
  PlaneRows rows;
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.kind == ObservationKind::kPlane) rows[{row.polygon, row.subject}] = &row;
  }
  Json::Value json(Json::arrayValue);
  for (size_t i = 0; i < survey.polygons.size(); ++i) {
    const PolygonOutline& outline = survey.polygons[i];
    Json::Value polygon;
    polygon["name"] = outline.name;
    polygon["material"] = outline.material;
    polygon["photo"] = outline.photo ? Json::Value(*outline.photo) : Json::Value();
    polygon["normal"] = ToJson(Eigen::VectorXd(adjustment.scene.polygons[i].normal));
    polygon["vertices"] = Vertices(outline, rows, adjustment.sigma0);
    Merge(OutlineReport(outline, MeasurePolygon(adjustment, outline, i)), &polygon);
    if (const AdjustedPlane* plane = FindPlane(adjustment, outline.name)) {
      Merge(PlaneReport(*plane, adjustment.scene.zenith), &polygon);
    }
    json.append(polygon);
  }
  return json;
}

Json::Value AdjoiningSection(const Adjustment& adjustment, const Survey& survey) {
  Json::Value json(Json::arrayValue);
  for (const auto& [first, second] : AdjoiningPolygons(survey)) {
    const AdjustedPlane* a = FindPlane(adjustment, survey.polygons[first].name);
    const AdjustedPlane* b = FindPlane(adjustment, survey.polygons[second].name);
    if (!a || !b) continue;
    const UncertainValue angle = AngleBetween(*a, *b);
    Json::Value pair;
    pair["first"] = a->polygon;
    pair["second"] = b->polygon;
    pair["angle_deg"] = angle.value / kDegree;
    pair["sigma_deg"] = angle.sigma / kDegree;
    const UncertainValue off_square{angle.value - M_PI / 2, angle.sigma};
    if (std::abs(off_square.value) < kNearlySquare) pair["perpendicularity"] = Slope(off_square);
    json.append(pair);
  }
  return json;
}

Json::Value PlaneEffectSection(const PlaneEffect& effect) {
  Json::Value json;
  json["unknown_because"] = effect.unknown_because;
  json["redundancy_without"] = effect.redundancy;
  json["sigma0_without"] = effect.sigma0;
  json["test"]["statistic"] = effect.statistic;
  json["test"]["degrees"] = effect.degrees;
  json["test"]["limit"] = effect.limit;
  json["test"]["alpha"] = effect.alpha;
  json["test"]["is_met"] = effect.statistic <= effect.limit;
  json["held_by_planes"] = Json::Value(Json::arrayValue);
  for (const std::string& name : effect.held_by_planes) json["held_by_planes"].append(name);
  json["shifts"] = Json::Value(Json::arrayValue);
  for (const PlaneEffect::Shift& shift : effect.shifts) {
    Json::Value row;
    row["name"] = shift.name;
    row["difference_m"] = ToJson(Eigen::VectorXd(shift.difference));
    row["sigma_m"] = shift.sigma ? Json::Value(*shift.sigma) : Json::Value();
    row["w"] = shift.w ? Json::Value(*shift.w) : Json::Value();
    json["shifts"].append(row);
  }
  return json;
}

Json::Value DirectionsSection(const Adjustment& adjustment, const Survey& survey) {
  Json::Value json;
  const SceneGeometry& scene = adjustment.scene;
  json["sun"] = scene.sun ? DirectionReport(*scene.sun, survey.sun_pairs.size()) : Json::Value();
  json["zenith"] = DirectionReport(scene.zenith, survey.zenith_pairs.size());
  return json;
}

}  // namespace insitu
