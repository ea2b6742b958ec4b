// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/material.h"

#include <filesystem>

#include "calibration/files/json_file.h"
#include "radiometry/light/fresnel.h"

namespace insitu {
namespace {

double NumberOr(const JsonNode& material, const std::string& key, double otherwise) {
  const auto found = material.Find(key);
  return found ? found->Number() : otherwise;
}

double ReadWeight(const JsonNode& material) {
  const double weight = NumberOr(material, "specular_weight", 1);
  if (weight < 0 || weight > 1) {
    throw material.At("specular_weight").Error("is out of range, expected 0 to 1");
  }
  return weight;
}

double ReadIndex(const JsonNode& material) {
  const JsonNode ior = material.At("ior");
  if (ior.Number() <= 1) throw ior.Error("is not an index of refraction, expected above 1");
  return ior.Number();
}

std::optional<Specular> ReadSpecular(const JsonNode& material) {
  const auto kind = material.Find("specular");
  if (!kind || kind->Text() == "none") return std::nullopt;
  if (kind->Text() != "fresnel" && kind->Text() != "mirror") {
    throw kind->Error("is \"" + kind->Text() + "\", expected \"none\", \"fresnel\" or \"mirror\"");
  }
  if (NumberOr(material, "roughness", 0) != 0) {
    throw material.At("roughness")
        .Error("is a rough mirror's, which cannot be shown yet, expected 0 or null");
  }
  Specular specular;
  specular.weight = ReadWeight(material);
  if (kind->Text() == "fresnel") specular.index = ReadIndex(material);
  return specular;
}

NaturalMaterial ReadMaterial(const JsonNode& material) {
  NaturalMaterial result;
  result.specular = ReadSpecular(material);
  result.diffuse_weight = NumberOr(material, "diffuse_weight", 1);
  if (result.diffuse_weight <= 0) {
    throw material.At("diffuse_weight").Error("is out of range, expected above 0");
  }
  const auto diffuse = material.Find("diffuse");
  if (diffuse && diffuse->Text() != "from photo") {
    throw diffuse->Error("is \"" + diffuse->Text() + "\", expected \"from photo\"");
  }
  return result;
}

}  // namespace

double MirrorWeight(const std::optional<Specular>& specular, double cosine) {
  if (!specular) return 0;
  return specular->weight * (specular->index ? FresnelReflectance(cosine, *specular->index) : 1);
}

std::map<std::string, NaturalMaterial> ReadNaturalMaterials(const SitePaths& site) {
  const std::filesystem::path path = site.survey() / "materials.json";
  std::map<std::string, NaturalMaterial> materials;
  if (!std::filesystem::exists(path)) return materials;
  for (const auto& [name, material] : JsonNode::Load(path).At("materials").Members()) {
    materials[name] = ReadMaterial(material);
  }
  return materials;
}

}  // namespace insitu
