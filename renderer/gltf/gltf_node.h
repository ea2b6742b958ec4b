// SPDX-License-Identifier: GPL-3.0-or-later
// Where the nodes of a glTF scene stand, in double precision.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "renderer/gltf/gltf_file.h"
#include "renderer/mesh/model.h"

namespace insitu {

// A node with a mesh or a lamp.
struct GltfNode {
  std::string layer;                             // its name, else that of the next one above
  std::vector<Eigen::Affine3d> world_from_node;  // [m], z up; several of an instanced one
  int mesh = -1;                                 // -1: none
  int light = -1;                                // of KHR_lights_punctual; -1: none
};

// Of the file's scene, or of all nodes that no other holds. Nodes that are said to be invisible,
// cameras and skins are counted as skipped. Throws InputError: a node that is not there, nodes more
// than 1000 deep or more than ten million.
std::vector<GltfNode> ReadGltfNodes(GltfFile* file, Model* model);

}  // namespace insitu
