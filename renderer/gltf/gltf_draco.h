// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes compressed by Draco (KHR_draco_mesh_compression), by Debian's libdraco.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gltf/gltf_accessor.h"

namespace insitu {

struct DracoMesh {
  std::vector<uint32_t> indices;                 // three a triangle
  std::map<std::string, GltfValues> attributes;  // by glTF's names
};

// `ids`: glTF's name of an attribute -> its number in the data. nullopt: damaged, no triangles.
std::optional<DracoMesh> DecodeDraco(std::string_view bytes, const std::map<std::string, int>& ids);

}  // namespace insitu
