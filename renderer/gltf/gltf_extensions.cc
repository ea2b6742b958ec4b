// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_extensions.h"

#include <algorithm>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "renderer/gltf/gltf_json.h"

namespace insitu {
namespace {

bool IsRead(const std::string& extension) {
  static const std::set<std::string> kRead = {"KHR_mesh_quantization",
                                              "EXT_meshopt_compression",
                                              "KHR_draco_mesh_compression",
                                              "EXT_mesh_gpu_instancing",
                                              "KHR_texture_transform",
                                              "KHR_materials_unlit",
                                              "KHR_materials_pbrSpecularGlossiness",
                                              "KHR_materials_transmission",
                                              "KHR_materials_volume",
                                              "KHR_materials_diffuse_transmission",
                                              "KHR_materials_ior",
                                              "KHR_materials_emissive_strength",
                                              "KHR_lights_punctual",
                                              "KHR_node_visibility",
                                              "EXT_texture_webp",
                                              "KHR_xmp_json_ld"};
  return kRead.contains(extension);
}

// Only a look is lost without them: the faces stand where they should.
bool IsLookAlone(const std::string& extension) {
  static const std::set<std::string> kLooks = {"KHR_texture_basisu", "MSFT_texture_dds",
                                               "EXT_texture_avif", "KHR_texture_video"};
  return extension.starts_with("KHR_materials_") || extension.starts_with("EXT_materials_") ||
         kLooks.contains(extension);
}

std::string RtcCenter(const GltfFile& file) {
  const auto center = NumbersOf(ExtensionOf(file.json(), "CESIUM_RTC"), "center", 3);
  if (!center) return "";
  return Formatted(
      ": its coordinates are relative to (%.10g, %.10g, %.10g), which is not added; place the "
      "building by placement.json",
      (*center)[0], (*center)[1], (*center)[2]);
}

// Those that stand somewhere, declared or not.
void AddExtensionsIn(const Json::Value& value, std::set<std::string>* names) {
  if (value.isObject() && MemberOf(value, "extensions").isObject()) {
    for (const std::string& name : value["extensions"].getMemberNames()) names->insert(name);
  }
  if (!value.isArray() && !value.isObject()) return;
  for (const Json::Value& item : value) AddExtensionsIn(item, names);
}

}  // namespace

std::vector<std::string> CheckGltfExtensions(const GltfFile& file) {
  for (const std::string& name : TextsOf(file.json(), "extensionsRequired")) {
    if (IsRead(name) || IsLookAlone(name)) continue;
    throw InputError(file.path(), "requires the glTF extension " + name.substr(0, 60) +
                                      ", which is not read: export it without, or as OBJ, IFC or "
                                      "DXF");
  }
  std::vector<std::string> warnings;
  std::set<std::string> used;
  for (const std::string& name : TextsOf(file.json(), "extensionsUsed")) used.insert(name);
  AddExtensionsIn(file.json(), &used);
  for (const std::string& name : used) {
    if (IsRead(name)) continue;
    const std::string more = name == "CESIUM_RTC" ? RtcCenter(file) : "";
    warnings.push_back(
        InputError(file.path(), "uses the glTF extension " + name.substr(0, 60) +
                                    ", which is not read" +
                                    (more.empty() ? ": what it says is left out" : more))
            .what());
  }
  return warnings;
}

bool UsesDraco(const GltfFile& file) {
  const auto used = TextsOf(file.json(), "extensionsUsed");
  return std::ranges::find(used, "KHR_draco_mesh_compression") != used.end();
}

}  // namespace insitu
