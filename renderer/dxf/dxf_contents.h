// SPDX-License-Identifier: GPL-3.0-or-later
// What a DXF drawing holds: units, layers, blocks, and the model space.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/dxf/dxf_block.h"

namespace insitu {

struct DxfLayer {
  bool frozen = false;   // neither its entities nor the blocks inserted on it are shown
  bool off = false;      // its entities are not shown
  bool no_plot = false;  // its entities are not printed
  std::optional<Eigen::Vector3d> rgb;  // linear Rec. 709
};

struct DxfDrawing {
  std::string version;  // $ACADVER, "AC1032"; empty: not named
  bool binary = false;
  std::optional<double> metres_per_unit;   // nullopt: the drawing names none
  std::map<std::string, DxfLayer> layers;  // by NameKey; those of the layer table
  std::map<std::string, DxfBlock> blocks;  // by NameKey
  DxfBlock model_space;
  std::vector<std::string> warnings;                   // with the file's name
  std::vector<std::filesystem::path> files;            // that it refers to and that were read
  std::map<std::string, std::string> block_of_handle;  // of the table of blocks
  std::map<std::string, std::string> body_of_handle;   // SAB of entities, by DxfHandle
  // A state of a dynamic block, "*U3" by NameKey -> handle of the block that a user named.
  std::map<std::string, std::string> dynamic_block;
};

}  // namespace insitu
