// SPDX-License-Identifier: GPL-3.0-or-later
// glTF, COLLADA and PLY, by Assimp.
#pragma once

#include <filesystem>

#include "renderer/formats/model_format.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Node names become layers, materials keep their names, colours and textures. Assimp runs in a
// process of its own, so that no file can break or stall the program. Assimp's coordinates are of
// single precision: a warning says how much that is if it exceeds 1 mm.
// A glTF extension that is used and not read is a warning.
// Throws InputError: one that is required and not read, by name; what Assimp says of the file; a
// file that breaks it or takes it longer than `seconds` or over 3 GB; a file that was cut.
Model ReadWithAssimp(const std::filesystem::path& path, ModelFormat format, int seconds);

}  // namespace insitu
