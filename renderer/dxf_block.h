// SPDX-License-Identifier: GPL-3.0-or-later
// What one block of a drawing, or its model space, holds: surfaces, and insertions of other blocks.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "renderer/dxf.h"
#include "renderer/dxf_record.h"

namespace insitu {

// A reference to a block; drawing units, radians.
struct DxfInsert {
  DxfRecord record;  // for messages
  std::string block;
  std::string layer;
  Eigen::Affine3d holder_from_block;  // of the first copy; block coordinates about its base point
  int columns = 1, rows = 1;
  Eigen::Vector3d column_step, row_step;  // between copies, in the holder's coordinates
};

struct DxfBlock {
  Eigen::Vector3d base =
      Eigen::Vector3d::Zero();  // its coordinates that come to the INSERT's point
  DxfModel content;  // in the block's own coordinates and drawing units, layer 0 not yet resolved
  std::vector<DxfInsert> inserts;
  bool external = false;  // a reference to another drawing
};

// The axes of an entity's own coordinate system, as columns, from its extrusion direction (group
// 210; z if absent), by AutoCAD's arbitrary axis algorithm. Throws InputError: a zero direction.
Eigen::Matrix3d DxfEntityAxes(const DxfRecord& entity);

// Reads the entities between BLOCK and ENDBLK, or those of section ENTITIES. Throws InputError.
DxfBlock ReadDxfEntities(std::span<const DxfRecord> entities);

}  // namespace insitu
