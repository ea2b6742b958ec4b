// SPDX-License-Identifier: GPL-3.0-or-later
// Which glTF extensions are read.
#pragma once

#include <string>
#include <vector>

#include "renderer/gltf/gltf_file.h"

namespace insitu {

// What a user must know of those that are used and not read, a warning each. Throws InputError: one
// that is required and not read, by name, as the specification demands.
std::vector<std::string> CheckGltfExtensions(const GltfFile& file);

// Whether the file holds meshes compressed by Draco, whose library may break on faulty ones.
bool UsesDraco(const GltfFile& file);

}  // namespace insitu
