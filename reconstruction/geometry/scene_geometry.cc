// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reconstruction/geometry/intersection.h"
#include "reconstruction/geometry/plane.h"
#include "reconstruction/geometry/polygon_rings.h"

namespace insitu {
namespace {

constexpr char kFormat[] = "insitu scene 1";

Json::Value DirectionToJson(const Direction& direction) {
  Json::Value json;
  json["unit"] = ToJson(Eigen::VectorXd(direction.unit));
  json["covariance"] = ToJson(Eigen::MatrixXd(direction.covariance));
  return json;
}

Json::Value PolygonToJson(const Polygon& polygon, const std::vector<PosedCamera>& cameras) {
  Json::Value json;
  json["name"] = polygon.name;
  json["material"] = polygon.material;
  json["photo"] = polygon.photo ? Json::Value(cameras[*polygon.photo].photo) : Json::Value();
  json["normal"] = ToJson(Eigen::VectorXd(polygon.normal));
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    json["vertices"].append(ToJson(Eigen::VectorXd(vertex)));
  }
  if (!polygon.holes.empty()) json["holes"] = HolesToJson(polygon.holes);
  if (polygon.covariance.size() > 0) json["covariance"] = ToJson(polygon.covariance);
  return json;
}

Direction DirectionFromJson(const JsonNode& node) {
  Direction direction{node.At("unit").Vector3(), Eigen::Matrix3d::Zero()};
  if (std::abs(direction.unit.norm() - 1) > 1e-9) throw node.Error("expected a unit vector");
  const std::vector<JsonNode> rows = node.At("covariance").Items();
  if (rows.size() != 3) throw node.Error("expected a covariance of three rows");
  for (int row = 0; row < 3; ++row) direction.covariance.row(row) = rows[row].Vector3();
  return direction;
}

int CameraIndex(const std::vector<PosedCamera>& cameras, const JsonNode& photo) {
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].photo == photo.Text()) return static_cast<int>(i);
  }
  throw photo.Error("photo '" + photo.Text() + "' is not among the scene's cameras");
}

Polygon PolygonFromJson(const JsonNode& node, const std::vector<PosedCamera>& cameras) {
  Polygon polygon;
  polygon.name = node.At("name").Text();
  polygon.material = node.At("material").Text();
  polygon.normal = node.At("normal").Vector3();
  if (std::abs(polygon.normal.norm() - 1) > 1e-9) throw node.Error("expected a unit normal");
  if (const auto photo = node.Find("photo")) polygon.photo = CameraIndex(cameras, *photo);
  for (const JsonNode& vertex : node.At("vertices").Items()) {
    polygon.vertices.push_back(vertex.Vector3());
  }
  if (polygon.vertices.size() < 3) throw node.Error("expected at least three vertices");
  if (const auto holes = node.Find("holes")) polygon.holes = HolesFromJson(*holes);
  if (const auto fault = FaultOfRings(polygon.vertices, polygon.holes, polygon.normal)) {
    throw node.Error("polygon '" + polygon.name + "': " + fault->what.text());
  }
  if (const auto covariance = node.Find("covariance")) {
    polygon.covariance = covariance->Matrix();
    const auto rows = static_cast<Eigen::Index>(3 * AllVertices(polygon).size());
    if (polygon.covariance.rows() != rows || polygon.covariance.cols() != rows) {
      throw covariance->Error("expected three rows and columns a vertex");
    }
  }
  return polygon;
}

Eigen::MatrixXd CovarianceFromJson(const JsonNode& node, const Camera& camera) {
  const std::vector<JsonNode> rows = node.Items();
  const auto size = static_cast<Eigen::Index>(rows.size());
  if (size != 6 && size != 6 + static_cast<Eigen::Index>(camera.intrinsics().size())) {
    throw node.Error("expected a covariance of six rows, or six and the lens's");
  }
  Eigen::MatrixXd covariance(size, size);
  for (Eigen::Index row = 0; row < size; ++row) {
    const std::vector<double> numbers = rows[row].Numbers();
    if (static_cast<Eigen::Index>(numbers.size()) != size) {
      throw rows[row].Error("expected as many numbers as the covariance has rows");
    }
    covariance.row(row) = Eigen::Map<const Eigen::RowVectorXd>(numbers.data(), size);
  }
  return covariance;
}

}  // namespace

std::vector<Eigen::Vector3d> AllVertices(const Polygon& polygon) {
  std::vector<Eigen::Vector3d> vertices = polygon.vertices;
  for (const auto& hole : polygon.holes) vertices.insert(vertices.end(), hole.begin(), hole.end());
  return vertices;
}

double AreaOf(const Polygon& polygon) {
  double area = AreaOf(polygon.vertices);
  for (const auto& hole : polygon.holes) area -= AreaOf(hole);
  return std::max(area, 0.0);
}

std::optional<int> LargestLevelPolygon(const SceneGeometry& scene) {
  const double level = std::cos(10 * std::numbers::pi / 180);
  std::optional<int> largest;
  for (size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    if (polygon.normal.dot(scene.zenith.unit) <= level) continue;
    if (!largest || AreaOf(polygon) > AreaOf(scene.polygons[*largest])) {
      largest = static_cast<int>(i);
    }
  }
  return largest;
}

Json::Value HolesToJson(const std::vector<std::vector<Eigen::Vector3d>>& holes) {
  Json::Value json(Json::arrayValue);
  for (const auto& hole : holes) {
    Json::Value& ring = json.append(Json::Value(Json::arrayValue));
    for (const Eigen::Vector3d& vertex : hole) ring.append(ToJson(Eigen::VectorXd(vertex)));
  }
  return json;
}

std::vector<std::vector<Eigen::Vector3d>> HolesFromJson(const JsonNode& node) {
  std::vector<std::vector<Eigen::Vector3d>> holes;
  for (const JsonNode& ring : node.Items()) {
    std::vector<Eigen::Vector3d>& hole = holes.emplace_back();
    for (const JsonNode& vertex : ring.Items()) hole.push_back(vertex.Vector3());
    if (hole.size() < 3) throw ring.Error("expected a hole of at least three vertices");
  }
  return holes;
}

std::optional<std::vector<Eigen::Vector3i>> TrianglesOf(const Polygon& polygon) {
  return TriangulateRings(polygon.vertices, polygon.holes, polygon.normal);
}

bool HasInterior(const Polygon& polygon) { return TrianglesOf(polygon).has_value(); }

void WriteSceneGeometry(const SitePaths& site, const SceneGeometry& scene) {
  Json::Value json;
  json["format"] = kFormat;
  json["origin"] = ToJson(Eigen::VectorXd(scene.origin));
  json["cameras"] = Json::Value(Json::arrayValue);
  for (const PosedCamera& camera : scene.cameras) {
    WritePosedCamera(site.posed_camera(camera.photo), camera, "exterior orientation by insitu");
    json["cameras"].append(camera.photo);
  }
  for (size_t i = 0; i < scene.camera_covariances.size(); ++i) {
    json["camera_covariances"][scene.cameras[i].photo] = ToJson(scene.camera_covariances[i]);
  }
  json["polygons"] = Json::Value(Json::arrayValue);
  for (const Polygon& polygon : scene.polygons) {
    json["polygons"].append(PolygonToJson(polygon, scene.cameras));
  }
  json["sun"] = scene.sun ? DirectionToJson(*scene.sun) : Json::Value();
  json["zenith"] = DirectionToJson(scene.zenith);
  json["vertex_sigma"] = scene.vertex_sigma;
  WriteJson(site.scene(), json);
}

SceneGeometry ReadSceneGeometry(const SitePaths& site) {
  RequireResult(site.scene(), "insitu-reconstruct");
  const JsonNode root = JsonNode::Load(site.scene());
  if (const JsonNode format = root.At("format"); format.Text() != kFormat) {
    throw format.Error("expected \"" + std::string(kFormat) + "\"");
  }
  SceneGeometry scene;
  scene.origin = root.At("origin").Vector3();
  for (const JsonNode& photo : root.At("cameras").Items()) {
    scene.cameras.push_back(ReadPosedCamera(site.posed_camera(photo.Text())));
  }
  if (const auto covariances = root.Find("camera_covariances")) {
    for (const PosedCamera& camera : scene.cameras) {
      scene.camera_covariances.push_back(
          CovarianceFromJson(covariances->At(camera.photo), camera.camera));
    }
  }
  for (const JsonNode& polygon : root.At("polygons").Items()) {
    scene.polygons.push_back(PolygonFromJson(polygon, scene.cameras));
  }
  if (const auto sun = root.Find("sun")) scene.sun = DirectionFromJson(*sun);
  scene.zenith = DirectionFromJson(root.At("zenith"));
  scene.vertex_sigma = root.At("vertex_sigma").Number();
  return scene;
}

std::optional<Eigen::Vector3d> PointOnPolygon(const PosedCamera& camera,
                                              const Eigen::Vector2d& pixel,
                                              const Polygon& polygon) {
  const Eigen::Vector3d inside = FitPlane(polygon.vertices).point;
  const std::optional<Eigen::Vector3d> hit =
      IntersectPlane({&camera, pixel}, polygon.normal, polygon.normal.dot(inside));
  if (!hit) return std::nullopt;
  const auto outline = ProjectOutline(polygon.vertices, polygon.normal, inside);
  const auto point = ProjectOutline({*hit}, polygon.normal, inside);
  if (!IsInside(outline, point[0])) return std::nullopt;
  for (const auto& hole : polygon.holes) {
    if (IsInside(ProjectOutline(hole, polygon.normal, inside), point[0])) return std::nullopt;
  }
  return hit;
}

}  // namespace insitu
