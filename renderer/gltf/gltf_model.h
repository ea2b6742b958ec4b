// SPDX-License-Identifier: GPL-3.0-or-later
// glTF 2, text and binary. Read by ourselves: Assimp keeps node transforms in single precision, 25
// cm at the northing of a national grid, and knows no quantisation, instancing or meshopt.
#pragma once

#include "renderer/gltf/gltf_file.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Node names become layers; materials keep their names, colours and images; punctual lights become
// lamps. Vertices in metres, z up. Throws InputError: what the file's parts state
// (CheckGltfExtensions, ReadGltfNodes, ReadGltfPrimitive, ReadGltfMaterial).
Model ReadGltf(GltfFile file);

}  // namespace insitu
