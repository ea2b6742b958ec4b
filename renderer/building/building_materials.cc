// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_materials.h"

#include <fnmatch.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "calibration/files/file_beside.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"
#include "radiometry/spectrum/spectral_table.h"
#include "renderer/building/data_map.h"
#include "renderer/building/material_maps.h"
#include "renderer/building/material_optics.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

double Share(const JsonNode& node) {
  const double share = node.Number();
  if (share < 0 || share > 1) throw node.Error("is out of range, expected 0 to 1");
  return share;
}

double ShareOr(const MaterialKeys& material, const std::string& key, double if_absent) {
  const auto node = material.Find(key);
  return node ? Share(*node) : if_absent;
}

Vector3d Albedo(const JsonNode& node) {
  const Vector3d rgb = node.Vector3();
  if (rgb.minCoeff() < 0 || rgb.maxCoeff() > 1) {
    throw node.Error("is no albedo, expected three values from 0 to 1");
  }
  return rgb;
}

Vector3d AlbedoOfSrgb(const JsonNode& node) {
  const Vector3d codes = node.Vector3();
  if (codes.minCoeff() < 0 || codes.maxCoeff() > 255) {
    throw node.Error("is no sRGB colour, expected three values from 0 to 255");
  }
  return codes.unaryExpr([](double code) { return LinearFromSrgb(code / 255); });
}

Vector3d AlbedoOfLab(const JsonNode& material, const JsonNode& node) {
  const auto white = material.Find("lab_white");
  const std::string name = white ? white->Text() : "D65";
  if (name != "D65" && name != "D50") {
    throw white->Error("is \"" + name + "\", expected D65 or D50");
  }
  const Vector3d lab = node.Vector3();
  if (lab.x() < 0 || lab.x() > 100) throw node.Error("has no L from 0 to 100");
  // A colour outside Rec. 709 is brought to its border.
  return LinearFromLab(lab, name == "D50").cwiseMax(0).cwiseMin(1);
}

void CheckReflectance(const JsonNode& node, const SpectralTable& table) {
  for (const Eigen::Vector2d& row : table) {
    if (row.y() > 1) throw node.Error("has a value above 1, expected reflectances from 0 to 1");
  }
  RequireVisibleRange(table, node);
}

void ReadColor(const JsonNode& material, SurfaceMaterial* surface) {
  if (const auto rgb = material.Find("diffuse_rgb")) {
    surface->diffuse_rgb = Albedo(*rgb);
  } else if (const auto srgb = material.Find("diffuse_srgb")) {
    surface->diffuse_rgb = AlbedoOfSrgb(*srgb);
  } else if (const auto lab = material.Find("diffuse_lab")) {
    surface->diffuse_rgb = AlbedoOfLab(material, *lab);
  } else if (const auto table = material.Find("reflectance")) {
    surface->reflectance = ReadSpectralTable(*table);
    CheckReflectance(*table, surface->reflectance);
  } else {
    const JsonNode file = material.At("reflectance_file");
    surface->reflectance = ReadSpectralTable(FileBeside(file));
    CheckReflectance(file, surface->reflectance);
  }
  if (!surface->reflectance.empty()) {
    surface->diffuse_rgb = ColorOfReflectance(surface->reflectance);
  }
}

// The image says the colour; its mean stands for it in light among surfaces. `building` is the
// folder of materials.json; entries of a library lie elsewhere.
void ReadTexture(const JsonNode& node, const fs::path& building, SurfaceMaterial* surface) {
  const bool is_beside = node.path().parent_path() == building;
  surface->texture = is_beside ? node.Text() : fs::absolute(FileBeside(node)).string();
  surface->diffuse_rgb = MeanColor(ReadPhotograph(FileBeside(node)).linear);
}

void ReadTextureSize(const MaterialKeys& material, SurfaceMaterial* surface) {
  const auto size = material.Find("texture_size_m");
  if (!size) return;
  const std::vector<JsonNode> metres = size->Items();
  if (metres.size() != 2 || !(metres[0].Number() > 0) || !(metres[1].Number() > 0)) {
    throw size->Error("is no size, expected [width, height] of one repeat in metres");
  }
  surface->texture_size = Eigen::Vector2d(metres[0].Number(), metres[1].Number());
}

// What materials.json can refer to: its own section "library", and the one that is installed.
struct Libraries {
  std::map<std::string, MaterialKeys> own;
  const MaterialLibrary& installed;
};

// Of an entry, and below them those of what it uses.
MaterialKeys KeysOf(const JsonNode& node, const Libraries& libraries) {
  MaterialKeys keys(node);
  const auto use = node.Find("use");
  if (!use) return keys;
  const auto own = libraries.own.find(use->Text());
  if (own != libraries.own.end()) {
    keys.PutBelow(own->second);
  } else {
    keys.PutBelow(libraries.installed.Material(*use).content);
  }
  return keys;
}

bool HasPattern(const std::string& name) { return name.find_first_of("*?") != std::string::npos; }

}  // namespace

BuildingMaterial ReadBuildingMaterial(const std::string& name, const MaterialKeys& keys,
                                      const fs::path& building) {
  BuildingMaterial material;
  material.surface.name = name;
  const auto hidden = keys.Find("hidden");
  material.hidden = hidden && hidden->Boolean();
  if (material.hidden) return material;
  material.is_proposed = keys.Find("proposed") && !keys.Find("use");
  const auto color = keys.WithAnyOf(
      {"texture", "diffuse_rgb", "diffuse_srgb", "diffuse_lab", "reflectance", "reflectance_file"});
  if (!color) {
    throw keys.Error(
        "names no colour, expected diffuse_rgb, diffuse_srgb, diffuse_lab, reflectance, "
        "reflectance_file, texture or, of the library, use");
  }
  if (const auto texture = color->Find("texture")) {
    ReadTexture(*texture, building, &material.surface);
  } else {
    ReadColor(*color, &material.surface);
  }
  material.surface.diffuse_weight = ShareOr(keys, "diffuse_weight", 1);
  ReadOptics(keys, &material.surface);
  ReadMaps(keys, building, &material.surface, &material.warnings);
  if (!material.surface.texture.empty() || !material.surface.maps.empty()) {
    ReadTextureSize(keys, &material.surface);
  }
  return material;
}

BuildingMaterials BuildingMaterials::Read(const fs::path& path, const MaterialLibrary& installed) {
  BuildingMaterials result;
  if (!fs::exists(path)) return result;
  const JsonNode root = JsonNode::Load(path);
  Libraries libraries{{}, installed};
  if (const auto section = root.Find("library")) {
    for (const auto& [name, node] : section->Members()) {
      const MaterialKeys keys = KeysOf(node, libraries);
      ReadBuildingMaterial(name, keys, path.parent_path());  // is it right?
      libraries.own.emplace(name, keys);
    }
  }
  const auto read = [&](const JsonNode& section, Section* entries) {
    for (const auto& [name, node] : section.Members()) {
      (*entries)[name].material =
          ReadBuildingMaterial(name, KeysOf(node, libraries), path.parent_path());
    }
  };
  const auto materials = root.Find("materials"), blocks = root.Find("blocks");
  if (materials) read(*materials, &result.materials_);
  if (blocks) read(*blocks, &result.blocks_);
  if (!materials && !blocks) {
    read(root.At("layers"), &result.layers_);
  } else if (const auto layers = root.Find("layers")) {
    read(*layers, &result.layers_);
  }
  return result;
}

BuildingMaterials::Entry* BuildingMaterials::FindIn(Section* section, const std::string& name) {
  if (name.empty()) return nullptr;
  if (const auto exact = section->find(name); exact != section->end()) return &exact->second;
  const std::string key = NameKey(name);
  Entry* best = nullptr;
  size_t longest = 0;
  for (auto& [pattern, entry] : *section) {
    const std::string pattern_key = NameKey(pattern);
    if (pattern_key == key) return &entry;
    if (!HasPattern(pattern) || pattern.size() <= longest) continue;
    if (fnmatch(pattern_key.c_str(), key.c_str(), FNM_NOESCAPE) != 0) continue;
    best = &entry;
    longest = pattern.size();
  }
  return best;
}

const BuildingMaterial* BuildingMaterials::Find(const SurfaceNames& names) {
  Entry* entry = nullptr;
  const std::pair<Section*, const std::string*> places[] = {{&materials_, &names.material},
                                                            {&layers_, &names.material},
                                                            {&blocks_, &names.block},
                                                            {&layers_, &names.block},
                                                            {&layers_, &names.layer}};
  for (const auto& [section, name] : places) {
    if (!entry) entry = FindIn(section, *name);
  }
  if (!entry) return nullptr;
  entry->used = true;
  return &entry->material;
}

std::vector<std::string> BuildingMaterials::Proposed() const {
  std::vector<std::string> names;
  for (const Section* section : {&materials_, &blocks_, &layers_}) {
    for (const auto& [name, entry] : *section) {
      if (entry.material.is_proposed) names.push_back(name);
    }
  }
  return names;
}

std::vector<std::string> BuildingMaterials::Unused() const {
  std::vector<std::string> names;
  const auto add = [&names](const char* what, const Section& section) {
    for (const auto& [name, entry] : section) {
      if (!entry.used) names.push_back(std::string(what) + " \"" + name + "\"");
    }
  };
  add("material", materials_);
  add("block", blocks_);
  add("layer", layers_);
  return names;
}

}  // namespace insitu
