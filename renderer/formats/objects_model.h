// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's own objects, typed by hand: polygons, polyhedra and spheres. [Durisch92, §3.6]
#pragma once

#include <filesystem>
#include <string_view>

#include "renderer/mesh/model.h"

namespace insitu {

// Whether a file is one: it is called objects.json, or names itself "insitu objects".
bool IsObjectsFile(const std::filesystem::path& path, std::string_view head);

// Metres, z up; spheres stay spheres. An object's layer is its name unless it states one. Polygons
// may have holes. Throws InputError at its line: another format or version, a key that is not
// known, a polygon or a face that is not planar to a millimetre, crosses itself or has no area, a
// hole that is not within it, a radius that is not above 0. A polyhedron whose faces leave it open
// is a warning.
Model ReadObjects(const std::filesystem::path& path);

}  // namespace insitu
