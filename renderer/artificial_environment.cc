// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/artificial_environment.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include "calibration/json_file.h"
#include "calibration/whole_file.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kVersion = 1;
static_assert(std::endian::native == std::endian::little, "building.bin is written as in memory");

std::filesystem::path MeshPath(const SitePaths& site) {
  return site.artificial().replace_extension(".bin");
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

Json::Value MaterialJson(const SurfaceMaterial& material) {
  Json::Value json;
  json["name"] = material.name;
  json["diffuse_rgb"] = ToJson(Eigen::VectorXd(material.diffuse_rgb));
  json["diffuse_weight"] = material.diffuse_weight;
  if (material.specular) {
    json["specular"]["weight"] = material.specular->weight;
    if (material.specular->index) json["specular"]["index"] = *material.specular->index;
  }
  return json;
}

SurfaceMaterial MaterialOf(const JsonNode& node) {
  SurfaceMaterial material;
  material.name = node.At("name").Text();
  material.diffuse_rgb = node.At("diffuse_rgb").Vector3();
  material.diffuse_weight = node.At("diffuse_weight").Number();
  if (const auto specular = node.Find("specular")) {
    material.specular = Specular{specular->At("weight").Number(), std::nullopt};
    if (const auto index = specular->Find("index")) material.specular->index = index->Number();
  }
  return material;
}

Json::Value LightJson(const PointLight& light) {
  Json::Value json;
  json["name"] = light.name;
  json["position"] = ToJson(Eigen::VectorXd(light.position));
  json["intensity_rgb"] = ToJson(Eigen::VectorXd(light.intensity_rgb));
  return json;
}

PointLight LightOf(const JsonNode& node) {
  return {node.At("name").Text(), node.At("position").Vector3(),
          node.At("intensity_rgb").Vector3()};
}

Json::Value MeshJson(const SitePaths& site, const ArtificialEnvironment& environment,
                     std::string_view bytes) {
  Json::Value json;
  json["file"] = MeshPath(site).filename().string();
  json["layout"] =
      "little-endian: x y z of each vertex [m, float64], corners of each triangle [3 int32, from "
      "0], material of each triangle [int32, from 0]";
  json["vertices"] = Json::Value::Int64(environment.vertices.size());
  json["triangles"] = Json::Value::Int64(environment.triangles.size());
  json["checksum"] = Checksum(bytes);
  return json;
}

int CountOf(const JsonNode& node) {
  if (node.Integer() < 0) throw node.Error("is negative, expected a count");
  return node.Integer();
}

void ReadMesh(const SitePaths& site, const JsonNode& mesh, ArtificialEnvironment* environment) {
  const std::filesystem::path path = site.artificial().parent_path() / mesh.At("file").Text();
  const std::string content = ReadWhole(path);
  const size_t vertices = CountOf(mesh.At("vertices")), triangles = CountOf(mesh.At("triangles"));
  const size_t size = vertices * sizeof(Vector3d) + triangles * (sizeof(Vector3i) + sizeof(int));
  if (content.size() != size || Checksum(content) != mesh.At("checksum").Text()) {
    throw InputError(path, "does not belong to " + site.artificial().filename().string() +
                               ", expected the mesh written with it: run insitu-convert again");
  }
  std::string_view rest = content;
  environment->vertices = Take<Vector3d>(vertices, &rest);
  environment->triangles = Take<Vector3i>(triangles, &rest);
  environment->material_of_triangle = Take<int>(triangles, &rest);
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

void WriteArtificialEnvironment(const SitePaths& site, const ArtificialEnvironment& environment) {
  INSITU_CHECK(environment.material_of_triangle.size() == environment.triangles.size());
  const std::string bytes = MeshBytes(environment);
  Json::Value json;
  json["version"] = kVersion;
  json["mesh"] = MeshJson(site, environment, bytes);
  json["materials"] = Json::arrayValue;
  for (const auto& material : environment.materials)
    json["materials"].append(MaterialJson(material));
  json["lights"] = Json::arrayValue;
  for (const auto& light : environment.lights) json["lights"].append(LightJson(light));
  WriteWhole(MeshPath(site), bytes);
  WriteJson(site.artificial(), json);
}

ArtificialEnvironment ReadArtificialEnvironment(const SitePaths& site) {
  RequireResult(site.artificial(), "insitu-convert");
  const JsonNode root = JsonNode::Load(site.artificial());
  if (root.At("version").Integer() != kVersion) {
    throw root.At("version").Error("is not a version this program reads, expected " +
                                   std::to_string(kVersion));
  }
  ArtificialEnvironment environment;
  for (const JsonNode& node : root.At("materials").Items()) {
    environment.materials.push_back(MaterialOf(node));
  }
  for (const JsonNode& node : root.At("lights").Items()) {
    environment.lights.push_back(LightOf(node));
  }
  ReadMesh(site, root.At("mesh"), &environment);
  CheckIndices(site.artificial(), environment);
  return environment;
}

}  // namespace insitu
