// SPDX-License-Identifier: GPL-3.0-or-later
// Images of a planned material beside that of its colour.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiometry/library/material_keys.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Of a material's entry, images beside the file that names them, at the places of `texture`:
//   roughness_map: slopes, in place of roughness, or with roughness_map_is "root" their roots, as
//   glTF and most programs have them; metallic_map: 1 where it is bare metal of its colour;
//   metallic_roughness_map: glTF's, roughness (its root) green, metal blue; all three need
//   specular; transmission_map: times transmission, which it needs; normal_map, with normal_scale
//   (1): tangent space of glTF, +Y up; height_map, with height_m: how much higher white is than
//   black.
// One that cannot be read is left out, and told to `warnings`, a line each. Throws InputError: what
// a map needs is missing or out of range.
void ReadMaps(const MaterialKeys& material, const std::filesystem::path& building,
              SurfaceMaterial* surface, std::vector<std::string>* warnings);

// The maps that a model names by path, of a surface that `building`/materials.json does not list.
// What is rough or metal in places is a coat over its colour, or bare metal of it, as in glTF.
void AddModelMaps(const SurfaceNames& names, const std::filesystem::path& building,
                  SurfaceMaterial* surface, std::vector<std::string>* warnings);

// Adds a map of the image `path`, which is named `map.file` from building/, with what its mean says
// of the surface as a whole. Throws InputError: missing, not an image.
void AddMap(SurfaceMap map, const std::filesystem::path& path, SurfaceMaterial* surface);

}  // namespace insitu
