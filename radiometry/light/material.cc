// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/material.h"

#include <filesystem>

#include "radiometry/library/json_fault.h"
#include "radiometry/library/material_library.h"

namespace insitu {
namespace {

double NumberOr(const MaterialKeys& material, const std::string& key, double otherwise) {
  const auto found = material.Find(key);
  return found ? found->Number() : otherwise;
}

double Share(const MaterialKeys& material, const std::string& key, double otherwise) {
  const double share = NumberOr(material, key, otherwise);
  if (share < 0 || share > 1) {
    throw JsonFault(material.At(key), Sentence("shareRange", "is out of range, expected 0 to 1"));
  }
  return share;
}

double ReadIndex(const MaterialKeys& material) {
  const JsonNode ior = material.At("ior");
  if (ior.Number() <= 1) {
    throw JsonFault(ior,
                    Sentence("materialIndex", "is not an index of refraction, expected above 1"));
  }
  return ior.Number();
}

FacetDistribution ReadDistribution(const MaterialKeys& material) {
  const auto name = material.Find("distribution");
  if (!name || name->Text() == "ggx") return FacetDistribution::kGgx;
  if (name->Text() == "beckmann") return FacetDistribution::kBeckmann;
  throw JsonFault(
      *name, Sentence("materialDistribution", "is \"{text}\", expected \"ggx\" or \"beckmann\"",
                      {{"text", name->Text()}}));
}

}  // namespace

std::optional<Specular> ReadSpecular(const MaterialKeys& material, bool may_be_metal) {
  const auto node = material.Find("specular");
  const std::string kind = node ? node->Text() : "none";
  if (kind == "none") return std::nullopt;
  if (kind != "fresnel" && kind != "mirror" && !(may_be_metal && kind == "conductor")) {
    throw JsonFault(
        *node,
        may_be_metal
            ? Sentence("materialMetal",
                       "is \"{kind}\", expected \"none\", \"fresnel\", \"mirror\" or \"conductor\"",
                       {{"kind", kind}})
            : Sentence("materialSpecular",
                       "is \"{kind}\", expected \"none\", \"fresnel\" or \"mirror\"",
                       {{"kind", kind}}));
  }
  Specular specular{Share(material, "specular_weight", 1), {}, {}};
  if (kind == "fresnel") specular.index = ReadIndex(material);
  specular.roughness = {Share(material, "roughness", 0), ReadDistribution(material)};
  return specular;
}

Json::Value SpecularJson(const Specular& specular) {
  Json::Value json;
  json["weight"] = specular.weight;
  if (specular.index) json["index"] = *specular.index;
  if (specular.roughness.slope == 0) return json;
  json["roughness"] = specular.roughness.slope;
  const bool is_ggx = specular.roughness.distribution == FacetDistribution::kGgx;
  json["distribution"] = is_ggx ? "ggx" : "beckmann";
  return json;
}

Specular SpecularOf(const JsonNode& node) {
  Specular specular{node.At("weight").Number(), {}, {}};
  if (const auto index = node.Find("index")) specular.index = index->Number();
  specular.roughness = {Share(node, "roughness", 0), ReadDistribution(node)};
  return specular;
}

NaturalMaterial ReadNaturalMaterial(const MaterialKeys& material) {
  NaturalMaterial result;
  result.specular = ReadSpecular(material);
  result.bumps = ReadBumps(material);
  if (result.bumps && !result.specular) {
    throw JsonFault(
        material.At("bumps"),
        Sentence(
            "materialBumps",
            "is of a surface that mirrors nothing: its photograph shows what light makes of them"));
  }
  result.diffuse_weight = NumberOr(material, "diffuse_weight", 1);
  if (result.diffuse_weight <= 0) {
    throw JsonFault(material.At("diffuse_weight"),
                    Sentence("weightRange", "is out of range, expected above 0"));
  }
  result.transmission = Share(material, "transmission", 0);
  const auto diffuse = material.Find("diffuse");
  if (diffuse && diffuse->Text() != "from photo") {
    throw JsonFault(*diffuse, Sentence("materialDiffuse", "is \"{text}\", expected \"from photo\"",
                                       {{"text", diffuse->Text()}}));
  }
  return result;
}

std::map<std::string, NaturalMaterial> ReadNaturalMaterials(const SitePaths& site) {
  const std::filesystem::path path = site.survey() / "materials.json";
  std::map<std::string, NaturalMaterial> materials;
  if (!std::filesystem::exists(path)) return materials;
  const MaterialLibrary library(LibraryFolders(site));
  for (const auto& [name, material] : JsonNode::Load(path).At("materials").Members()) {
    MaterialKeys keys(material);
    if (const auto use = material.Find("use")) keys.PutBelow(library.Material(*use).content);
    materials[name] = ReadNaturalMaterial(keys);
  }
  return materials;
}

}  // namespace insitu
