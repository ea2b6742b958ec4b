// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/material_maps.h"

#include <algorithm>

#include "calibration/files/error.h"
#include "calibration/files/file_beside.h"
#include "renderer/building/data_map.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Kind = SurfaceMap::Kind;

class MapsReader {
 public:
  MapsReader(const MaterialKeys& material, const fs::path& building, SurfaceMaterial* surface,
             std::vector<std::string>* warnings)
      : material_(material), building_(building), surface_(*surface), warnings_(*warnings) {}

  void Read() {
    Add("roughness_map", {{.kind = Kind::kRoughness, .is_squared = IsRoot()}});
    Add("metallic_map", {{.kind = Kind::kMetallic}});
    Add("metallic_roughness_map", {{.kind = Kind::kRoughness, .channel = 1, .is_squared = true},
                                   {.kind = Kind::kMetallic, .channel = 2}});
    const double weight = surface_.glass ? surface_.glass->weight : 1;
    Add("transmission_map", {{.kind = Kind::kTransmission, .factor = weight}});
    Add("normal_map", {{.kind = Kind::kNormal, .factor = NumberOr("normal_scale", 1)}});
    if (material_.Find("height_map")) {
      const JsonNode height = material_.At("height_m");
      if (!(height.Number() > 0)) throw height.Error("is not above 0, expected metres");
      Add("height_map", {{.kind = Kind::kHeight, .factor = height.Number()}});
    }
  }

 private:
  double NumberOr(const char* key, double if_absent) const {
    const auto node = material_.Find(key);
    return node ? node->Number() : if_absent;
  }

  bool IsRoot() const {
    const auto node = material_.Find("roughness_map_is");
    if (!node) return false;
    if (node->Text() != "root" && node->Text() != "slope") {
      throw node->Error("is \"" + node->Text() + "\", expected slope or root");
    }
    return node->Text() == "root";
  }

  void Require(const JsonNode& node, Kind kind) const {
    if (kind == Kind::kTransmission && !surface_.glass) {
      throw node.Error("needs transmission, which it is multiplied by");
    }
    if ((kind == Kind::kRoughness || kind == Kind::kMetallic) && !surface_.specular) {
      throw node.Error("needs specular: without it nothing is mirrored");
    }
  }

  void Add(const char* key, const std::vector<SurfaceMap>& maps) {
    const auto node = material_.Find(key);
    if (!node) return;
    for (SurfaceMap map : maps) {
      Require(*node, map.kind);
      const bool is_beside = node->path().parent_path() == building_;
      try {
        const fs::path path = FileBeside(*node);
        map.file = is_beside ? node->Text() : fs::absolute(path).string();
        AddMap(map, path, &surface_);
      } catch (const InputError& error) {
        warnings_.push_back(std::string(error.what()) + ": " + key + " is left out of \"" +
                            surface_.name + "\"");
        return;
      }
    }
  }

  const MaterialKeys& material_;
  const fs::path& building_;
  SurfaceMaterial& surface_;
  std::vector<std::string>& warnings_;
};

}  // namespace

void ReadMaps(const MaterialKeys& material, const fs::path& building, SurfaceMaterial* surface,
              std::vector<std::string>* warnings) {
  MapsReader(material, building, surface, warnings).Read();
}

void AddModelMaps(const SurfaceNames& names, const fs::path& building, SurfaceMaterial* surface,
                  std::vector<std::string>* warnings) {
  for (SurfaceMap map : names.maps) {
    const bool mirrors = map.kind == Kind::kRoughness || map.kind == Kind::kMetallic;
    if (mirrors && surface->glass) continue;
    const fs::path path = map.file;
    std::error_code none;
    map.file = fs::proximate(path, building, none).string();
    const std::optional<Specular> before = surface->specular;
    if (mirrors && !before) surface->specular = Specular{1, names.index};
    try {
      AddMap(map, path, surface);
    } catch (const InputError& error) {
      surface->specular = before;
      warnings->push_back(std::string(error.what()) + ": the map is left out of \"" +
                          surface->name + "\"");
    }
  }
}

void AddMap(SurfaceMap map, const fs::path& path, SurfaceMaterial* surface) {
  const Raster data = ReadDataMap(path, map);
  if (!IsRelief(map)) map.mean = std::clamp(MeanOf(data, map), 0.0, 1.0);
  surface->maps.push_back(map);
  if (map.kind == Kind::kRoughness && surface->specular) {
    surface->specular->roughness.slope = map.mean;
  }
  if (map.kind == Kind::kTransmission && surface->glass) surface->glass->weight = map.mean;
}

}  // namespace insitu
