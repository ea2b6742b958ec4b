// SPDX-License-Identifier: GPL-3.0-or-later
// What one block of a drawing, or its model space, holds: surfaces, and insertions of other blocks.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/dxf/dxf_path.h"
#include "renderer/dxf/dxf_record.h"
#include "renderer/mesh/model.h"

namespace insitu {

constexpr int kColorByBlock = 0;
constexpr int kColorByLayer = 256;

// How an entity is to look, before its layer and its INSERT have their say.
struct DxfLook {
  std::string layer = "0";
  int color = kColorByLayer;      // AutoCAD's index, kColorByLayer or kColorByBlock
  std::optional<int> true_color;  // 0xRRGGBB; goes before the index

  bool operator==(const DxfLook&) const = default;
};

// A reference to a block; drawing units, radians.
struct DxfInsert {
  DxfPlace place;  // for messages
  std::string block;
  DxfLook look;
  Eigen::Affine3d holder_from_block;  // of the first copy; block coordinates about its base point
  int columns = 1, rows = 1;
  Eigen::Vector3d column_step, row_step;  // between copies, in the holder's coordinates
};

// An ACIS body: 3DSOLID, BODY, REGION, a surface.
struct DxfBody {
  int look = 0;
  std::string kind, handle;
  std::string text;  // SAT; empty: the drawing holds it as SAB under its handle
};

// Coordinates are the block's own, in drawing units.
struct DxfBlock {
  std::string name;                                // empty: model space
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  // what comes to the INSERT's point
  std::vector<DxfLook> looks;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> look_of_triangle;
  std::vector<DxfPath> paths;
  std::vector<DxfBody> bodies;
  std::vector<DxfInsert> inserts;
  std::map<std::pair<int, std::string>, int> kinds_of_look;  // (look, kind) -> entities read
  std::map<std::string, int> entities;                       // kind -> count, read or not
  SkippedEntities skipped;
  int degenerate_faces = 0;
  bool external = false;      // a reference to another drawing, which is not read
  bool is_overlay = false;    // one that further drawings do not show
  std::string external_file;  // as the drawing names it
  std::string why_unread;     // "which is not there: ..."
};

}  // namespace insitu
