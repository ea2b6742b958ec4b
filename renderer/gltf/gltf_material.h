// SPDX-License-Identifier: GPL-3.0-or-later
// What a glTF material says of a surface.
#pragma once

#include <Eigen/Geometry>

#include "renderer/gltf/gltf_file.h"
#include "renderer/mesh/model.h"

namespace insitu {

struct GltfMaterial {
  SurfaceNames names;                                                // without a layer
  int texture_set = 0;                                               // TEXCOORD_n of its colour
  Eigen::Affine2d image_from_texture = Eigen::Affine2d::Identity();  // KHR_texture_transform
};

// Colour and image of metallic-roughness or specular-glossiness; opacity by its alpha where
// alphaMode heeds it, or by its transmission; index, volume and absorption. Images that the file
// holds go to the model's images; what is said and not shown is counted as skipped. Throws
// InputError: no such material, texture or image.
GltfMaterial ReadGltfMaterial(GltfFile* file, int index, Model* model);

}  // namespace insitu
