// SPDX-License-Identifier: GPL-3.0-or-later
// PLY, text and binary. Read by ourselves: Assimp keeps coordinates in single precision, swallows a
// first byte that looks like the end of a line and makes up elements that are missing.
#pragma once

#include <filesystem>

#include "renderer/mesh/model.h"

namespace insitu {

// Faces and triangle strips of any number of corners, in any order of the elements; normals,
// texture coordinates and colours of vertices, colours of faces. The layer is the file's name.
// Coordinates are as the file has them, z up.
// Throws InputError: what ReadPlyHead states, an element that the file ends in, a value that is no
// number, a face that names a vertex out of range.
Model ReadPly(const std::filesystem::path& path);

}  // namespace insitu
