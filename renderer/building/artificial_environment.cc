// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/artificial_environment.h"

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kVersion = 4, kWithoutSpheres = 3;  // both are read
static_assert(std::endian::native == std::endian::little, "building.bin is written as in memory");

std::filesystem::path MeshPath(std::filesystem::path file) {
  return file.replace_extension(".bin");
}

template <typename T>
void Append(const std::vector<T>& values, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <typename T>
std::vector<T> Take(size_t count, std::string_view* bytes) {
  std::vector<T> values(count);
  if (count == 0) return values;
  std::memcpy(reinterpret_cast<char*>(values.data()), bytes->data(), count * sizeof(T));
  bytes->remove_prefix(count * sizeof(T));
  return values;
}

std::string MeshBytes(const ArtificialEnvironment& environment) {
  std::string bytes;
  Append(environment.vertices, &bytes);
  Append(environment.triangles, &bytes);
  Append(environment.material_of_triangle, &bytes);
  Append(environment.corner_normals, &bytes);
  Append(environment.corner_uvs, &bytes);
  return bytes;
}

// FNV-1a, 64 bits: tells whether the two files belong together.
std::string Checksum(std::string_view bytes) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[hash >> shift & 15];
  return text;
}

Json::Value TableJson(const SpectralTable& table) {
  Json::Value json(Json::arrayValue);
  for (const Eigen::Vector2d& row : table) json.append(ToJson(Eigen::VectorXd(row)));
  return json;
}

SpectralTable TableOf(const JsonNode& node) {
  SpectralTable table;
  for (const JsonNode& row : node.Items()) {
    const std::vector<double> values = row.Numbers();
    if (values.size() != 2) throw row.Error("has not two numbers, expected wavelength and value");
    table.emplace_back(values[0], values[1]);
  }
  return table;
}

Json::Value GlassJson(const Glass& glass) {
  Json::Value json;
  json["weight"] = glass.weight;
  json["is_solid"] = glass.is_solid;
  json["index"] = glass.index;
  json["thickness"] = glass.thickness;
  json["absorption_rgb"] = ToJson(glass.absorption_rgb);
  return json;
}

Glass GlassOf(const JsonNode& node) {
  return {node.At("weight").Number(), node.At("is_solid").Boolean(), node.At("index").Number(),
          node.At("thickness").Number(), node.At("absorption_rgb").Vector3()};
}

constexpr std::pair<const char*, SurfaceMap::Kind> kMapKinds[] = {
    {"roughness", SurfaceMap::Kind::kRoughness},
    {"metallic", SurfaceMap::Kind::kMetallic},
    {"transmission", SurfaceMap::Kind::kTransmission},
    {"normal", SurfaceMap::Kind::kNormal},
    {"height", SurfaceMap::Kind::kHeight}};

Json::Value MapJson(const SurfaceMap& map) {
  Json::Value json;
  for (const auto& [name, kind] : kMapKinds) {
    if (kind == map.kind) json["kind"] = name;
  }
  json["file"] = map.file;
  json["channel"] = map.channel;
  json["factor"] = map.factor;
  json["is_squared"] = map.is_squared;
  json["mean"] = map.mean;
  return json;
}

SurfaceMap MapOf(const JsonNode& node) {
  SurfaceMap map;
  const std::string stated = node.At("kind").Text();
  bool is_known = false;
  for (const auto& [name, kind] : kMapKinds) {
    if (stated != name) continue;
    map.kind = kind;
    is_known = true;
  }
  if (!is_known) throw node.At("kind").Error("is no kind of map: \"" + stated + "\"");
  map.file = node.At("file").Text();
  map.channel = node.At("channel").Integer();
  if (map.channel < 0 || map.channel > 2) throw node.At("channel").Error("is not 0, 1 or 2");
  map.factor = node.At("factor").Number();
  map.is_squared = node.At("is_squared").Boolean();
  map.mean = node.At("mean").Number();
  return map;
}

Json::Value MaterialJson(const SurfaceMaterial& material) {
  Json::Value json;
  json["name"] = material.name;
  json["diffuse_rgb"] = ToJson(Eigen::VectorXd(material.diffuse_rgb));
  json["diffuse_weight"] = material.diffuse_weight;
  if (material.specular) json["specular"] = SpecularJson(*material.specular);
  if (!material.reflectance.empty()) json["reflectance"] = TableJson(material.reflectance);
  if (!material.texture.empty()) json["texture"] = material.texture;
  if (material.texture_size) {
    for (const double metres : *material.texture_size) {
      json["texture_size_m"].append(metres);
    }
  }
  if ((material.specular_rgb.array() != 1).any()) {
    json["specular_rgb"] = ToJson(material.specular_rgb);
  }
  if (material.metal) {
    json["metal"]["index"] = TableJson(material.metal->index);
    json["metal"]["extinction"] = TableJson(material.metal->extinction);
  }
  if (material.glass) json["glass"] = GlassJson(*material.glass);
  if (material.bumps) json["bumps"] = BumpsJson(*material.bumps);
  if (!material.translucent_rgb.isZero(0)) {
    json["translucent_rgb"] = ToJson(material.translucent_rgb);
  }
  for (const SurfaceMap& map : material.maps) json["maps"].append(MapJson(map));
  if (!material.translucent.empty()) json["translucent"] = TableJson(material.translucent);
  return json;
}

SurfaceMaterial MaterialOf(const JsonNode& node) {
  SurfaceMaterial material;
  material.name = node.At("name").Text();
  material.diffuse_rgb = node.At("diffuse_rgb").Vector3();
  material.diffuse_weight = node.At("diffuse_weight").Number();
  if (const auto specular = node.Find("specular")) material.specular = SpecularOf(*specular);
  if (const auto table = node.Find("reflectance")) material.reflectance = TableOf(*table);
  if (const auto value = node.Find("texture")) material.texture = value->Text();
  if (const auto value = node.Find("texture_size_m")) {
    const std::vector<JsonNode> size = value->Items();
    material.texture_size = Eigen::Vector2d(size.at(0).Number(), size.at(1).Number());
  }
  if (const auto value = node.Find("specular_rgb")) material.specular_rgb = value->Vector3();
  if (const auto metal = node.Find("metal")) {
    material.metal = Metal{TableOf(metal->At("index")), TableOf(metal->At("extinction"))};
  }
  if (const auto glass = node.Find("glass")) material.glass = GlassOf(*glass);
  if (const auto bumps = node.Find("bumps")) material.bumps = BumpsOf(*bumps);
  if (const auto value = node.Find("translucent_rgb")) material.translucent_rgb = value->Vector3();
  if (const auto maps = node.Find("maps")) {
    for (const JsonNode& map : maps->Items()) material.maps.push_back(MapOf(map));
  }
  if (const auto table = node.Find("translucent")) material.translucent = TableOf(*table);
  return material;
}

Json::Value NumbersJson(const std::vector<double>& values) {
  return ToJson(Eigen::VectorXd(Eigen::VectorXd::Map(values.data(), std::ssize(values))));
}

Json::Value DistributionJson(const LightDistribution& distribution) {
  Json::Value json;
  json["world_from_lamp"] = ToJson(Eigen::MatrixXd(distribution.world_from_lamp));
  json["gamma_deg"] = NumbersJson(distribution.gamma_deg);
  json["c_deg"] = NumbersJson(distribution.c_deg);
  json["values"] = NumbersJson(distribution.values);
  return json;
}

LightDistribution DistributionOf(const JsonNode& node) {
  LightDistribution distribution;
  const std::vector<JsonNode> rows = node.At("world_from_lamp").Items();
  if (rows.size() != 3) throw node.Error("world_from_lamp has not 3 rows");
  for (int i = 0; i < 3; ++i) distribution.world_from_lamp.row(i) = rows[i].Vector3().transpose();
  distribution.gamma_deg = node.At("gamma_deg").Numbers();
  distribution.c_deg = node.At("c_deg").Numbers();
  distribution.values = node.At("values").Numbers();
  if (distribution.gamma_deg.empty() || distribution.c_deg.empty() ||
      distribution.values.size() != distribution.gamma_deg.size() * distribution.c_deg.size()) {
    throw node.Error("has not a value for each pair of angles");
  }
  return distribution;
}

Json::Value LightJson(const PointLight& light) {
  Json::Value json;
  json["name"] = light.name;
  json["position"] = ToJson(Eigen::VectorXd(light.position));
  json["intensity_rgb"] = ToJson(Eigen::VectorXd(light.intensity_rgb));
  if (light.distribution) json["distribution"] = DistributionJson(*light.distribution);
  if (!light.spectrum.empty()) json["spectrum"] = TableJson(light.spectrum);
  if (light.candela != 0) json["candela"] = light.candela;
  if (light.radius != 0) json["radius"] = light.radius;
  if (!light.edge_u.isZero(0)) {
    json["edge_u"] = ToJson(light.edge_u);
    json["edge_v"] = ToJson(light.edge_v);
  }
  if (light.is_visible) json["is_visible"] = true;
  return json;
}

PointLight LightOf(const JsonNode& node) {
  PointLight light{node.At("name").Text(),
                   node.At("position").Vector3(),
                   node.At("intensity_rgb").Vector3(),
                   std::nullopt,
                   {},
                   0};
  if (const auto value = node.Find("distribution")) light.distribution = DistributionOf(*value);
  if (const auto value = node.Find("spectrum")) light.spectrum = TableOf(*value);
  if (const auto value = node.Find("candela")) light.candela = value->Number();
  if (const auto value = node.Find("radius")) light.radius = value->Number();
  if (const auto value = node.Find("edge_u")) light.edge_u = value->Vector3();
  if (const auto value = node.Find("edge_v")) light.edge_v = value->Vector3();
  if (const auto value = node.Find("is_visible")) light.is_visible = value->Boolean();
  return light;
}

Json::Value MeshJson(const std::filesystem::path& file, const ArtificialEnvironment& environment,
                     std::string_view bytes) {
  Json::Value json;
  json["file"] = MeshPath(file).filename().string();
  json["layout"] =
      "little-endian: x y z of each vertex [m, float64], corners of each triangle [3 int32, from "
      "0], material of each triangle [int32, from 0], then as stated below: unit normal of each "
      "corner [3 float32], UV of each corner [2 float32]";
  json["vertices"] = Json::Value::Int64(environment.vertices.size());
  json["triangles"] = Json::Value::Int64(environment.triangles.size());
  json["has_normals"] = !environment.corner_normals.empty();
  json["has_uvs"] = !environment.corner_uvs.empty();
  json["checksum"] = Checksum(bytes);
  return json;
}

Json::Value SphereJson(const EnvironmentSphere& sphere) {
  Json::Value json;
  json["center"] = ToJson(Eigen::VectorXd(sphere.center));
  json["radius"] = sphere.radius;
  json["material"] = sphere.material;
  return json;
}

EnvironmentSphere SphereOf(const JsonNode& node, size_t materials) {
  const EnvironmentSphere sphere{node.At("center").Vector3(), node.At("radius").Number(),
                                 node.At("material").Integer()};
  if (!(sphere.radius > 0)) throw node.At("radius").Error("is not above 0");
  if (sphere.material < 0 || static_cast<size_t>(sphere.material) >= materials) {
    throw node.At("material").Error("names a material that is not there");
  }
  return sphere;
}

int CountOf(const JsonNode& node) {
  if (node.Integer() < 0) throw node.Error("is negative, expected a count");
  return node.Integer();
}

void ReadMesh(const SitePaths& site, const JsonNode& mesh, ArtificialEnvironment* environment) {
  const std::filesystem::path path = site.artificial().parent_path() / mesh.At("file").Text();
  const std::string content = ReadWhole(path);
  const size_t vertices = CountOf(mesh.At("vertices")), triangles = CountOf(mesh.At("triangles"));
  const size_t normals = mesh.At("has_normals").Boolean() ? 3 * triangles : 0;
  const size_t uvs = mesh.At("has_uvs").Boolean() ? 3 * triangles : 0;
  const size_t size = vertices * sizeof(Vector3d) + triangles * (sizeof(Vector3i) + sizeof(int)) +
                      normals * sizeof(Eigen::Vector3f) + uvs * sizeof(Eigen::Vector2f);
  if (content.size() != size || Checksum(content) != mesh.At("checksum").Text()) {
    throw InputError(path, "does not belong to " + site.artificial().filename().string() +
                               ", expected the mesh written with it: run insitu-convert again");
  }
  std::string_view rest = content;
  environment->vertices = Take<Vector3d>(vertices, &rest);
  environment->triangles = Take<Vector3i>(triangles, &rest);
  environment->material_of_triangle = Take<int>(triangles, &rest);
  environment->corner_normals = Take<Eigen::Vector3f>(normals, &rest);
  environment->corner_uvs = Take<Eigen::Vector2f>(uvs, &rest);
}

void CheckIndices(const std::filesystem::path& path, const ArtificialEnvironment& environment) {
  const int vertices = static_cast<int>(environment.vertices.size());
  const int materials = static_cast<int>(environment.materials.size());
  for (size_t t = 0; t < environment.triangles.size(); ++t) {
    const Vector3i& triangle = environment.triangles[t];
    const int material = environment.material_of_triangle[t];
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= vertices || material < 0 ||
        material >= materials) {
      throw InputError(path, "triangle " + std::to_string(t) +
                                 " names a vertex or a material that is not there");
    }
  }
}

}  // namespace

void WriteArtificialEnvironmentFile(const std::filesystem::path& file,
                                    const ArtificialEnvironment& environment) {
  INSITU_CHECK(environment.material_of_triangle.size() == environment.triangles.size());
  const std::string bytes = MeshBytes(environment);
  Json::Value json;
  json["version"] = kVersion;
  json["mesh"] = MeshJson(file, environment, bytes);
  json["materials"] = Json::arrayValue;
  for (const auto& material : environment.materials)
    json["materials"].append(MaterialJson(material));
  json["spheres"] = Json::arrayValue;
  for (const auto& sphere : environment.spheres) json["spheres"].append(SphereJson(sphere));
  json["lights"] = Json::arrayValue;
  for (const auto& light : environment.lights) json["lights"].append(LightJson(light));
  WriteWhole(MeshPath(file), bytes);
  WriteJson(file, json);
}

void WriteArtificialEnvironment(const SitePaths& site, const ArtificialEnvironment& environment) {
  WriteArtificialEnvironmentFile(site.artificial(), environment);
}

ArtificialEnvironment ReadArtificialEnvironment(const SitePaths& site) {
  RequireResult(site.artificial(), "insitu-convert");
  const JsonNode root = JsonNode::Load(site.artificial());
  const int version = root.At("version").Integer();
  if (version != kVersion && version != kWithoutSpheres) {
    throw root.At("version").Error("is not a version this program reads, expected " +
                                   std::to_string(kVersion));
  }
  ArtificialEnvironment environment;
  for (const JsonNode& node : root.At("materials").Items()) {
    environment.materials.push_back(MaterialOf(node));
  }
  if (version == kVersion) {
    for (const JsonNode& node : root.At("spheres").Items()) {
      environment.spheres.push_back(SphereOf(node, environment.materials.size()));
    }
  }
  for (const JsonNode& node : root.At("lights").Items()) {
    environment.lights.push_back(LightOf(node));
  }
  ReadMesh(site, root.At("mesh"), &environment);
  CheckIndices(site.artificial(), environment);
  return environment;
}

}  // namespace insitu
