// SPDX-License-Identifier: GPL-3.0-or-later
// What the architect's layers, blocks and materials are made of: building/materials.json.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "radiometry/library/material_keys.h"
#include "radiometry/library/material_library.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/mesh/model.h"

namespace insitu {

struct BuildingMaterial {
  SurfaceMaterial surface;
  bool hidden = false;       // left out of the building
  bool is_proposed = false;  // an entry of the library is proposed for it, and not taken
  std::vector<std::string> warnings = {};  // of maps that are left out
};

// Of one entry, which `keys` are; `building` is the folder of materials.json, which textures are
// named relative to. Throws InputError as BuildingMaterials::Read.
BuildingMaterial ReadBuildingMaterial(const std::string& name, const MaterialKeys& keys,
                                      const std::filesystem::path& building);

// Sections "materials", "blocks" and "layers", each name -> material; names may hold * and ?.
// A material names its colour as one of
//   diffuse_rgb [r, g, b] (albedo, linear Rec. 709, 0..1), diffuse_srgb [r, g, b] (0..255, as RAL
//   and NCS colours are given for screens), diffuse_lab [L, a, b] with lab_white D65 or D50,
//   reflectance [[nm, value], ...] or reflectance_file (CSV: wavelength,value);
// and may say diffuse_weight, texture (an image beside materials.json, which goes before its
// colour), texture_size_m [width, height] (of one repeat: projected in metres), hidden, and what
// mirrors and lets light through (material_optics.h), and other images (material_maps.h). With use
// NAME it is an entry of section "library" or of the material library, whose keys the material's
// own go before. "proposed" in the place of "use", as insitu-materials --list writes it, changes
// nothing yet.
class BuildingMaterials {
 public:
  // Throws InputError: unreadable, weights or albedo outside 0..1, an unknown kind of specular,
  // Fresnel without an index above 1, a texture or table that is not there, a table that covers
  // less than the visible range, an unknown library name. Without a file there are no materials.
  static BuildingMaterials Read(const std::filesystem::path& path,
                                const MaterialLibrary& installed = {});

  // The material of a surface: by the first of its material, block and layer names that is listed,
  // in its own section or else in "layers"; exactly, else in any case, else by the longest pattern.
  // nullptr: none is listed.
  const BuildingMaterial* Find(const SurfaceNames& names);

  // Names whose proposal nobody has taken.
  std::vector<std::string> Proposed() const;

  // Names that Find has not met, as "layers NAME".
  std::vector<std::string> Unused() const;

 private:
  struct Entry {
    BuildingMaterial material;
    bool used = false;
  };
  using Section = std::map<std::string, Entry>;
  Entry* FindIn(Section* section, const std::string& name);

  Section materials_, blocks_, layers_;
};

}  // namespace insitu
