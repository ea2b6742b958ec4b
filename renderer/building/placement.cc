// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/placement.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>

#include "calibration/files/csv_file.h"
#include "calibration/files/json_file.h"
#include "reconstruction/geometry/coordinate_system.h"

namespace insitu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::filesystem::path PlacementPath(const SitePaths& site) {
  return site.building() / "placement.json";
}

double MetresOf(const JsonNode& unit) {
  static const std::map<std::string, double> kMetres = {
      {"mm", 1e-3},   {"cm", 1e-2},   {"dm", 1e-1},
      {"m", 1},       {"km", 1e3},    {"in", 0.0254},
      {"ft", 0.3048}, {"yd", 0.9144}, {"us-ft", 1200.0 / 3937}};
  const auto found = kMetres.find(unit.Text());
  if (found == kMetres.end()) {
    throw unit.Error("is \"" + unit.Text() + "\", expected mm, cm, dm, m, km, in, ft, us-ft or yd");
  }
  return found->second;
}

Eigen::Quaterniond RotationOf(const JsonNode& node) {
  if (const auto degrees = node.Find("rotation_deg")) {
    const double angle = degrees->Number() * std::numbers::pi / 180;
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
  }
  const auto rows = node.Find("rotation");
  if (!rows) return Eigen::Quaterniond::Identity();
  Matrix3d rotation;
  const std::vector<JsonNode> items = rows->Items();
  if (items.size() != 3) throw rows->Error("has not 3 rows, expected a 3 x 3 rotation");
  for (int i = 0; i < 3; ++i) rotation.row(i) = items[i].Vector3().transpose();
  const double misfit = (rotation * rotation.transpose() - Matrix3d::Identity()).norm();
  if (misfit > 1e-6 || rotation.determinant() < 0) {
    throw rows->Error("is no rotation, expected orthogonal rows of length 1, right-handed");
  }
  return Eigen::Quaterniond(rotation).normalized();
}

Vector3d ZUp(bool y_up, const Vector3d& v) { return y_up ? Vector3d(v.x(), -v.z(), v.y()) : v; }

std::map<std::string, CsvRow> SurveyPoints(const SitePaths& site) {
  std::map<std::string, CsvRow> points;
  const std::filesystem::path path = site.survey() / "control_points.csv";
  for (CsvRow& row : ReadCsv(path, {"name", "x", "y", "z", "sigma_x", "sigma_y", "sigma_z"})) {
    const std::string name = row.Text("name");
    points.emplace(name, std::move(row));
  }
  return points;
}

Vector3d SigmaOf(const JsonNode& pair, double otherwise) {
  const auto node = pair.Find("sigma");
  const double sigma = node ? node->Number() : otherwise;
  if (sigma > 0) return Vector3d::Constant(sigma);
  if (node) throw node->Error("is not above 0, expected a standard deviation [m]");
  throw pair.Error("names a point of sigma 0, expected \"sigma\" of the pair beside it [m]");
}

PointPair ReadPair(const SitePaths& site, const JsonNode& node, double metres, bool y_up) {
  constexpr double kUsualSigma = 0.01;
  PointPair pair;
  pair.points.source = metres * ZUp(y_up, node.At("model").Vector3());
  if (const auto point = node.Find("point")) {
    const auto points = SurveyPoints(site);
    const auto found = points.find(point->Text());
    if (found == points.end()) {
      throw point->Error("names \"" + point->Text() +
                         "\", which survey/control_points.csv does not hold");
    }
    const CsvRow& row = found->second;
    pair.name = point->Text();
    pair.points.target = {row.Number("x"), row.Number("y"), row.Number("z")};
    const Vector3d sigma(row.Number("sigma_x"), row.Number("sigma_y"), row.Number("sigma_z"));
    pair.points.sigma = SigmaOf(node, sigma.norm() / std::sqrt(3));
  } else {
    pair.points.target = node.At("survey").Vector3();
    pair.points.sigma = SigmaOf(node, kUsualSigma);
  }
  return pair;
}

double ScaleOf(const JsonNode& node) {
  const auto scale = node.Find("scale");
  if (!scale) return 1;
  if (!(scale->Number() > 0)) throw scale->Error("is not above 0, expected a scale");
  return scale->Number();
}

void ReadPairs(const SitePaths& site, const JsonNode& node, double metres, Placement* placement) {
  const auto pairs = node.Find("pairs");
  if (!pairs) return;
  for (const JsonNode& item : pairs->Items()) {
    placement->pairs.push_back(ReadPair(site, item, metres, placement->y_up));
    std::string& name = placement->pairs.back().name;
    if (name.empty()) name = "pair " + std::to_string(placement->pairs.size());
  }
  const auto free = node.Find("adjust_scale");
  const double factor = ScaleOf(node);
  std::vector<SimilarityPair> points;
  for (PointPair& pair : placement->pairs) {
    pair.points.source *= factor;
    points.push_back(pair.points);
  }
  placement->adjusted = AdjustSimilarity(points, free && free->Boolean());
  if (!placement->adjusted) {
    throw pairs->Error("do not fix the model, expected three or more pairs not on one line");
  }
  placement->world_from_model = placement->adjusted->target_from_source;
  placement->world_from_model.scale *= factor;
}

Placement PlacementOf(const SitePaths& site, const JsonNode& node, double metres_per_unit,
                      const std::optional<Similarity3>& map_from_model) {
  Placement placement;
  if (const auto unit = node.Find("unit")) placement.metres_per_unit = MetresOf(*unit);
  if (const auto up = node.Find("up")) {
    if (up->Text() != "y" && up->Text() != "z") throw up->Error("is neither \"y\" nor \"z\"");
    placement.y_up = up->Text() == "y";
  }
  const auto map = node.Find("map_conversion");
  if (map && map->Boolean()) {
    if (!map_from_model) throw map->Error("is true, but the model states no map conversion");
    placement.world_from_model = *map_from_model;
  } else if (node.Find("pairs")) {
    ReadPairs(site, node, placement.metres_per_unit.value_or(metres_per_unit), &placement);
  } else {
    placement.world_from_model.scale = ScaleOf(node);
    placement.world_from_model.rotation = RotationOf(node);
    if (const auto shift = node.Find("shift")) {
      placement.world_from_model.translation = shift->Vector3();
    }
  }
  if (node.Find("model_crs") || node.Find("survey_crs")) {
    placement.model_crs = node.At("model_crs").Text();
    placement.survey_crs = node.At("survey_crs").Text();
  }
  return placement;
}

// A sphere by its centre and the ends of three radii, which stay alike but for a map's distortion.
std::vector<Vector3d> PlacesOf(const std::vector<ModelSphere>& spheres) {
  std::vector<Vector3d> places;
  for (const ModelSphere& sphere : spheres) {
    places.push_back(sphere.center);
    for (int axis = 0; axis < 3; ++axis) {
      places.emplace_back(sphere.center + sphere.radius * Vector3d::Unit(axis));
    }
  }
  return places;
}

void SetPlaces(const std::vector<Vector3d>& places, std::vector<ModelSphere>* spheres) {
  for (size_t i = 0; i < spheres->size(); ++i) {
    ModelSphere& sphere = (*spheres)[i];
    sphere.center = places[4 * i];
    sphere.radius = 0;
    for (size_t end = 4 * i + 1; end < 4 * i + 4; ++end) {
      sphere.radius += (places[end] - sphere.center).norm() / 3;
    }
  }
}

// Vertices are metres by now: PROJ would take them for what the system counts in.
CoordinateSystem MetricSystem(const std::filesystem::path& file, const std::string& name) {
  const auto system = CoordinateSystem::FromText(name);
  if (!system) {
    throw InputError(file, "PROJ does not know the coordinate system \"" + name +
                               "\", expected one such as EPSG:2056");
  }
  const bool is_metric = !system->is_geographic() &&
                         std::abs(system->metres_per_unit() - 1) < 1e-12 &&
                         std::abs(system->metres_per_height() - 1) < 1e-12;
  if (is_metric) return *system;
  throw InputError(file, "the coordinate system \"" + name +
                             "\" is not in metres, heights included; expected a projected one in "
                             "metres, such as EPSG:2056");
}

void Convert(const std::filesystem::path& file, const Placement& placement,
             std::vector<Vector3d>* points) {
  const CoordinateConversion convert(MetricSystem(file, placement.model_crs),
                                     MetricSystem(file, placement.survey_crs));
  for (Vector3d& vertex : *points) {
    const auto converted = convert.WithHeight(vertex);
    if (!converted) {
      throw InputError(file, "PROJ cannot take (" + std::to_string(vertex.x()) + ", " +
                                 std::to_string(vertex.y()) + ") from " + placement.model_crs +
                                 " to " + placement.survey_crs);
    }
    vertex = *converted;
  }
}

}  // namespace

Placement ReadPlacement(const SitePaths& site, const std::string& name, double metres_per_unit,
                        const std::optional<Similarity3>& map_from_model) {
  const std::filesystem::path path = PlacementPath(site);
  if (!std::filesystem::exists(path)) return {};
  const JsonNode root = JsonNode::Load(path);
  if (const auto models = root.Find("models")) {
    if (const auto own = models->Find(name))
      return PlacementOf(site, *own, metres_per_unit, map_from_model);
  }
  return PlacementOf(site, root, metres_per_unit, map_from_model);
}

namespace {

void PlacePoints(const SitePaths& site, const Placement& placement, double metres_per_unit,
                 std::vector<Vector3d>* points) {
  const double unit = placement.metres_per_unit.value_or(metres_per_unit) / metres_per_unit;
  for (Vector3d& point : *points) {
    point = placement.world_from_model * ZUp(placement.y_up, unit * point);
  }
  if (!placement.model_crs.empty()) Convert(PlacementPath(site), placement, points);
}

}  // namespace

void Place(const SitePaths& site, const Placement& placement, double metres_per_unit,
           ModelMesh* mesh) {
  const Eigen::Quaterniond& rotation = placement.world_from_model.rotation;
  PlacePoints(site, placement, metres_per_unit, &mesh->vertices);
  std::vector<Vector3d> on_spheres = PlacesOf(mesh->spheres);
  PlacePoints(site, placement, metres_per_unit, &on_spheres);
  SetPlaces(on_spheres, &mesh->spheres);
  for (Eigen::Vector3f& normal : mesh->corner_normals) {
    normal = (rotation * ZUp(placement.y_up, normal.cast<double>())).cast<float>();
  }
}

// Each by its place and a point along its direction.
void PlaceLamps(const SitePaths& site, const Placement& placement, double metres_per_unit,
                std::vector<ModelLamp>* lamps) {
  std::vector<Vector3d> places;
  for (const ModelLamp& lamp : *lamps) {
    places.push_back(lamp.position);
    places.emplace_back(lamp.position + lamp.direction);
  }
  PlacePoints(site, placement, metres_per_unit, &places);
  for (size_t i = 0; i < lamps->size(); ++i) {
    ModelLamp& lamp = (*lamps)[i];
    lamp.position = places[2 * i];
    lamp.direction = (places[2 * i + 1] - lamp.position).normalized();
  }
}

}  // namespace insitu
