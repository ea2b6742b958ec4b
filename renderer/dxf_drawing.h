// SPDX-License-Identifier: GPL-3.0-or-later
// A DXF drawing as it stands in the file: units, layers, blocks, and the model space.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "renderer/dxf_block.h"

namespace insitu {

struct DxfLayer {
  bool frozen = false;  // neither its entities nor the blocks inserted on it are shown
  bool off = false;     // its entities are not shown
};

struct DxfDrawing {
  std::optional<double> metres_per_unit;   // nullopt: the drawing names none
  std::map<std::string, DxfLayer> layers;  // by DxfKey; those of the layer table
  std::map<std::string, DxfBlock> blocks;  // by DxfKey
  DxfBlock model_space;
};

// Names of layers and blocks that differ in case alone mean the same: their common key.
std::string DxfKey(const std::string& name);

// Throws InputError: a section that is not closed, an unknown unit, a faulty entity.
DxfDrawing ReadDxfDrawing(const DxfFile& file);

}  // namespace insitu
