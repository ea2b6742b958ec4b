// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building_materials.h"

#include <algorithm>

#include "calibration/json_file.h"

namespace insitu {
namespace {

double Share(const JsonNode& node) {
  const double share = node.Number();
  if (share < 0 || share > 1) throw node.Error("is out of range, expected 0 to 1");
  return share;
}

double ShareOr(const JsonNode& layer, const std::string& key, double if_absent) {
  const auto node = layer.Find(key);
  return node ? Share(*node) : if_absent;
}

Eigen::Vector3d Albedo(const JsonNode& node) {
  const Eigen::Vector3d rgb = node.Vector3();
  if (rgb.minCoeff() < 0 || rgb.maxCoeff() > 1) {
    throw node.Error("is no albedo, expected three values from 0 to 1");
  }
  return rgb;
}

void RefuseRoughness(const JsonNode& layer) {
  const auto roughness = layer.Find("roughness");
  if (roughness && roughness->Number() != 0) {
    throw roughness->Error("is not 0: this version shows smooth mirrors only, expected 0");
  }
}

std::optional<double> FresnelIndex(const JsonNode& layer) {
  const JsonNode index = layer.At("ior");
  if (index.Number() <= 1) throw index.Error("is no index of refraction, expected above 1");
  return index.Number();
}

std::optional<Specular> SpecularOf(const JsonNode& layer) {
  const auto node = layer.Find("specular");
  const std::string kind = node ? node->Text() : "none";
  if (kind == "none") return std::nullopt;
  if (kind != "fresnel" && kind != "mirror") {
    throw node->Error("is \"" + kind + "\", expected none, fresnel or mirror");
  }
  RefuseRoughness(layer);
  return Specular{ShareOr(layer, "specular_weight", 1),
                  kind == "fresnel" ? FresnelIndex(layer) : std::nullopt};
}

}  // namespace

std::map<std::string, SurfaceMaterial> ReadBuildingMaterials(const std::filesystem::path& path) {
  std::map<std::string, SurfaceMaterial> materials;
  for (const auto& [name, layer] : JsonNode::Load(path).At("layers").Members()) {
    materials[name] = {name, Albedo(layer.At("diffuse_rgb")), ShareOr(layer, "diffuse_weight", 1),
                       SpecularOf(layer)};
  }
  return materials;
}

std::vector<PointLight> ReadPointLights(const std::filesystem::path& path) {
  std::vector<PointLight> lights;
  for (const JsonNode& node : JsonNode::Load(path).At("lights").Items()) {
    const JsonNode intensity = node.At("intensity_rgb");
    lights.push_back({node.At("name").Text(), node.At("position").Vector3(), intensity.Vector3()});
    if (lights.back().intensity_rgb.minCoeff() < 0) {
      throw intensity.Error("is negative, expected a radiant intensity of 0 or more");
    }
  }
  return lights;
}

}  // namespace insitu
