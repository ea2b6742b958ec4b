// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/natural_environment.h"

#include <cmath>

#include "calibration/files/json_file.h"

namespace insitu {
namespace {

constexpr char kFormat[] = "insitu natural environment";
constexpr int kVersion = 1;

Json::Value Vector(const Eigen::Vector3d& vector) { return ToJson(Eigen::VectorXd(vector)); }

Json::Value Bins(const Spectrum& spectrum, const SpectralBins& bins) {
  return ToJson(Eigen::VectorXd(spectrum.head(bins.count).matrix()));
}

Json::Value CameraToJson(const PosedCamera& posed) {
  const Eigen::Quaterniond& rotation = posed.cam_from_world.rotation;
  const std::vector<double>& intrinsics = posed.camera.intrinsics();
  Json::Value json;
  json["photo"] = posed.photo;
  json["lens_model"] = posed.camera.lens_model();
  json["intrinsics"] =
      ToJson(Eigen::VectorXd(Eigen::VectorXd::Map(intrinsics.data(), intrinsics.size())));
  json["width"] = posed.camera.width();
  json["height"] = posed.camera.height();
  json["cam_from_world"]["rotation_wxyz"] = ToJson(
      Eigen::VectorXd(Eigen::Vector4d(rotation.w(), rotation.x(), rotation.y(), rotation.z())));
  json["cam_from_world"]["translation"] = Vector(posed.cam_from_world.translation);
  return json;
}

Json::Value PolygonToJson(const Polygon& polygon, const SceneGeometry& scene) {
  Json::Value json;
  json["name"] = polygon.name;
  for (const Eigen::Vector3d& vertex : polygon.vertices) json["vertices"].append(Vector(vertex));
  json["normal"] = Vector(polygon.normal);
  json["photo"] = polygon.photo ? Json::Value(scene.cameras[*polygon.photo].photo) : Json::Value();
  json["material"] = polygon.material;
  return json;
}

Json::Value DirectionToJson(const Direction& direction) {
  Json::Value json;
  json["unit"] = Vector(direction.unit);
  json["covariance"] = ToJson(Eigen::MatrixXd(direction.covariance));
  return json;
}

Json::Value SceneToJson(const SceneGeometry& scene) {
  Json::Value json;
  json["origin"] = Vector(scene.origin);
  json["cameras"] = Json::Value(Json::arrayValue);
  for (const PosedCamera& posed : scene.cameras) json["cameras"].append(CameraToJson(posed));
  json["polygons"] = Json::Value(Json::arrayValue);
  for (const Polygon& p : scene.polygons) json["polygons"].append(PolygonToJson(p, scene));
  json["sun"] = scene.sun ? DirectionToJson(*scene.sun) : Json::Value();
  json["zenith"] = DirectionToJson(scene.zenith);
  json["vertex_sigma"] = scene.vertex_sigma;
  return json;
}

Json::Value MaterialToJson(const NaturalMaterial& material) {
  Json::Value json;
  json["diffuse_weight"] = material.diffuse_weight;
  if (!material.specular) return json;
  json["specular"]["weight"] = material.specular->weight;
  if (material.specular->index) json["specular"]["index"] = *material.specular->index;
  return json;
}

Json::Value AirToJson(const Atmosphere& air, const SpectralBins& bins) {
  Json::Value json;
  json["horizon"] = Bins(air.horizon, bins);
  json["transmittance_per_m"] = Bins(air.transmittance, bins);
  return json;
}

Json::Value LightToJson(const Daylight& light, const SpectralBins& bins) {
  Json::Value json;
  json["sun_direction"] = Vector(light.sun_direction);
  json["sun_solid_angle"] = light.sun_solid_angle;
  json["zenith_direction"] = Vector(light.zenith_direction);
  json["polar_facets"] = light.polar_facets;
  json["sun_radiance"] = Bins(light.sun_radiance, bins);
  json["ambient_radiance"] = Bins(light.ambient_radiance, bins);
  json["sky_radiance"] = Bins(light.sky_radiance, bins);
  return json;
}

// Overwrites the used bins.
void ReadBins(const JsonNode& node, const SpectralBins& bins, Spectrum& spectrum) {
  const std::vector<double> values = node.Numbers();
  if (static_cast<int>(values.size()) != bins.count) {
    throw node.Error("has " + std::to_string(values.size()) + " values, expected one for each of " +
                     std::to_string(bins.count) + " bins");
  }
  std::copy(values.begin(), values.end(), spectrum.data());
}

Eigen::Vector3d ReadUnit(const JsonNode& node) {
  const Eigen::Vector3d unit = node.Vector3();
  if (std::abs(unit.norm() - 1) > 1e-9) throw node.Error("is not a unit vector, expected length 1");
  return unit;
}

Eigen::Quaterniond ReadRotation(const JsonNode& node) {
  const std::vector<double> q = node.Numbers();
  if (q.size() != 4) throw node.Error("is not a quaternion, expected w, x, y, z");
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (std::abs(rotation.norm() - 1) > 1e-9) {
    throw node.Error("is not a unit quaternion, expected length 1");
  }
  return rotation;
}

PosedCamera ReadCameraOf(const JsonNode& node) {
  const JsonNode pose = node.At("cam_from_world");
  const Rigid3 cam_from_world{ReadRotation(pose.At("rotation_wxyz")),
                              pose.At("translation").Vector3()};
  try {
    return {node.At("photo").Text(),
            Camera(node.At("lens_model").Text(), node.At("intrinsics").Numbers(),
                   node.At("width").Integer(), node.At("height").Integer()),
            cam_from_world};
  } catch (const std::invalid_argument& error) {
    throw node.Error(std::string("is not a camera: ") + error.what());
  }
}

int PhotoIndex(const JsonNode& photo, const SceneGeometry& scene) {
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].photo == photo.Text()) return static_cast<int>(i);
  }
  throw photo.Error("is the unknown photo \"" + photo.Text() + "\", expected one of the cameras'");
}

Polygon ReadPolygon(const JsonNode& node, const SceneGeometry& scene) {
  Polygon polygon;
  polygon.name = node.At("name").Text();
  for (const JsonNode& v : node.At("vertices").Items()) polygon.vertices.push_back(v.Vector3());
  polygon.normal = ReadUnit(node.At("normal"));
  if (polygon.vertices.size() < 3) {
    throw node.At("vertices").Error("has fewer than three vertices, expected a polygon");
  }
  if (const auto photo = node.Find("photo")) polygon.photo = PhotoIndex(*photo, scene);
  polygon.material = node.At("material").Text();
  return polygon;
}

Direction ReadDirection(const JsonNode& node) {
  Direction direction{ReadUnit(node.At("unit")), Eigen::Matrix3d::Zero()};
  const std::vector<JsonNode> rows = node.At("covariance").Items();
  if (rows.size() != 3) throw node.At("covariance").Error("is not a matrix, expected three rows");
  for (int i = 0; i < 3; ++i) direction.covariance.row(i) = rows[i].Vector3();
  return direction;
}

SceneGeometry ReadScene(const JsonNode& node) {
  SceneGeometry scene;
  scene.origin = node.At("origin").Vector3();
  for (const JsonNode& camera : node.At("cameras").Items()) {
    scene.cameras.push_back(ReadCameraOf(camera));
  }
  for (const JsonNode& polygon : node.At("polygons").Items()) {
    scene.polygons.push_back(ReadPolygon(polygon, scene));
  }
  if (const auto sun = node.Find("sun")) scene.sun = ReadDirection(*sun);
  scene.zenith = ReadDirection(node.At("zenith"));
  scene.vertex_sigma = node.At("vertex_sigma").Number();
  return scene;
}

NaturalMaterial ReadMaterial(const JsonNode& node) {
  NaturalMaterial material;
  material.diffuse_weight = node.At("diffuse_weight").Number();
  if (const auto specular = node.Find("specular")) {
    material.specular = Specular{specular->At("weight").Number(), std::nullopt};
    if (const auto index = specular->Find("index")) material.specular->index = index->Number();
  }
  return material;
}

std::map<std::string, NaturalMaterial> ReadMaterials(const JsonNode& root,
                                                     const SceneGeometry& scene) {
  std::map<std::string, NaturalMaterial> materials;
  const JsonNode node = root.At("materials");
  for (const auto& [name, material] : node.Members()) materials[name] = ReadMaterial(material);
  for (const Polygon& polygon : scene.polygons) {
    if (!materials.count(polygon.material)) {
      throw node.Error("lacks \"" + polygon.material + "\", expected every polygon's material");
    }
  }
  return materials;
}

Atmosphere ReadAir(const JsonNode& node, const SpectralBins& bins) {
  Atmosphere air;
  ReadBins(node.At("horizon"), bins, air.horizon);
  ReadBins(node.At("transmittance_per_m"), bins, air.transmittance);
  if (!(air.transmittance > 0 && air.transmittance <= 1).all()) {
    throw node.At("transmittance_per_m").Error("is out of range, expected above 0 and up to 1");
  }
  return air;
}

Daylight ReadLight(const JsonNode& node, const SpectralBins& bins) {
  Daylight light;
  light.sun_direction = ReadUnit(node.At("sun_direction"));
  light.sun_solid_angle = node.At("sun_solid_angle").Number();
  light.zenith_direction = ReadUnit(node.At("zenith_direction"));
  light.polar_facets = node.At("polar_facets").Integer();
  if (light.polar_facets < 1 || light.polar_facets > kMostPolarFacets) {
    throw node.At("polar_facets").Error("is not within 1 to 16");
  }
  ReadBins(node.At("sun_radiance"), bins, light.sun_radiance);
  ReadBins(node.At("ambient_radiance"), bins, light.ambient_radiance);
  ReadBins(node.At("sky_radiance"), bins, light.sky_radiance);
  return light;
}

SpectralBins ReadSpectralBins(const JsonNode& node) {
  const int count = node.Integer();
  if (count < 3 || count > kMaxBins) {
    throw node.Error("is out of range, expected 3 to " + std::to_string(kMaxBins));
  }
  return {count};
}

}  // namespace

Json::Value DescriptionOf(const NaturalEnvironment& environment) {
  const SpectralBins& bins = environment.spectra.bins();
  Json::Value json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["bins"] = bins.count;
  json["scene"] = SceneToJson(environment.scene);
  json["materials"] = Json::Value(Json::objectValue);
  for (const auto& [name, material] : environment.materials) {
    json["materials"][name] = MaterialToJson(material);
  }
  json["air"] = AirToJson(environment.air, bins);
  json["light"] = LightToJson(environment.light, bins);
  return json;
}

NaturalEnvironment ReadEnvironment(const SitePaths& site) {
  RequireResult(site.environment(), "insitu-light");
  const JsonNode root = JsonNode::Load(site.environment());
  const JsonNode format = root.At("format");
  if (format.Text() != kFormat) throw format.Error("expected \"" + std::string(kFormat) + "\"");
  const JsonNode version = root.At("version");
  if (version.Integer() != kVersion) {
    throw version.Error("is not readable here, expected " + std::to_string(kVersion));
  }
  NaturalEnvironment environment;
  environment.spectra = SpectralBasis(Rec709(), ReadSpectralBins(root.At("bins")));
  const SpectralBins& bins = environment.spectra.bins();
  environment.scene = ReadScene(root.At("scene"));
  environment.materials = ReadMaterials(root, environment.scene);
  environment.air = ReadAir(root.At("air"), bins);
  environment.light = ReadLight(root.At("light"), bins);
  return environment;
}

}  // namespace insitu
