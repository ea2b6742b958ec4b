// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of a glTF mesh's parts.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "renderer/gltf/gltf_accessor.h"
#include "renderer/mesh/model.h"

namespace insitu {

struct GltfPrimitive {
  GltfValues positions;                    // three a vertex
  GltfValues normals, colors;              // as many as positions, or none
  GltfValues uvs;                          // TEXCOORD_n asked for; as many as positions, or none
  std::vector<Eigen::Vector3i> triangles;  // indices into positions
};

// Lists, strips and fans, indexed or not, compressed or not; of points and lines, nothing.
// Attributes that are not read are counted as skipped. Throws InputError: no positions, an index
// beyond them, faulty compression.
GltfPrimitive ReadGltfPrimitive(GltfFile* file, const Json::Value& json, int texture_set,
                                Model* model);

}  // namespace insitu
