// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ and its material files. Read by ourselves, because Assimp keeps coordinates in
// single precision: 6 cm at the northing of a national grid.
#pragma once

#include <filesystem>

#include "renderer/mesh/model.h"

namespace insitu {

// v, vt, vn, f (negative indices, polygons of any size), o, g, usemtl, mtllib. A layer is an object
// and its group: "object", "group" or "object/group". Of a material: Kd (taken as linear
// reflectance), d or Tr, map_Kd. Coordinates are metres, or what a comment on units says; z up.
// A normal, texture coordinate or colour that is no number, or a face of fewer than three corners,
// costs only itself and is counted as skipped.
// Throws InputError at the line: a face that names a vertex out of range, a coordinate that is no
// finite number.
Model ReadObj(const std::filesystem::path& path);

}  // namespace insitu
