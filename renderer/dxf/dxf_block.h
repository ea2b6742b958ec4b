// SPDX-License-Identifier: GPL-3.0-or-later
// What one block of a drawing, or its model space, holds: surfaces, and insertions of other blocks.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
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

// Coordinates are the block's own, in drawing units.
struct DxfBlock {
  std::string name;                                // empty: model space
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  // what comes to the INSERT's point
  std::vector<DxfLook> looks;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> look_of_triangle;
  std::vector<DxfPath> paths;
  std::vector<DxfInsert> inserts;
  std::map<std::pair<int, std::string>, int> kinds_of_look;  // (look, kind) -> entities read
  std::map<std::string, int> entities;                       // kind -> count, read or not
  SkippedEntities skipped;
  int degenerate_faces = 0;
  bool external = false;  // a reference to another drawing
};

// The axes of an entity's own coordinate system, as columns, from its extrusion direction (group
// 210; z if absent), by AutoCAD's arbitrary axis algorithm. Throws InputError: a zero direction.
Eigen::Matrix3d DxfEntityAxes(const DxfRecord& entity);

// Fills one block from the records between BLOCK and ENDBLK, or those of section ENTITIES, as they
// come.
class DxfEntityReader {
 public:
  explicit DxfEntityReader(DxfBlock* block) : block_(block) {}
  // Throws InputError: a faulty entity.
  void Add(const DxfRecord& record);
  // What was begun is complete.
  void Finish();

 private:
  // A POLYLINE until its SEQEND; what it is follows from its flags.
  struct Polyline {
    DxfPlace place;
    int look = 0;
    int flags = 0;
    int rows = 0, columns = 0;                            // of a polygon mesh
    DxfPath path;                                         // of a flat polyline
    double start_width = 0, end_width = 0;                // of vertices that name none
    std::vector<Eigen::Vector3d> locations;               // of a polyface or a polygon mesh
    std::vector<std::pair<int, std::vector<int>>> faces;  // of a polyface: look, corners from 0
    bool hidden = false;                                  // skipped already
  };

  void Read(const DxfRecord& record);
  bool ReadSurface(const DxfRecord& record, int look);
  void BeginPolyline(const DxfRecord& record, int look);
  void AddVertex(const DxfRecord& vertex);
  void AddPolyfaceVertex(const DxfRecord& vertex, int flags);
  void AddPathVertex(const DxfRecord& vertex);
  void FinishPolygonMesh(const Polyline& polyline);
  void AddInsert(const DxfRecord& record, const DxfLook& look);
  void Skip(std::string_view kind, const std::string& reason);
  int LookIndex(const DxfLook& look);

  DxfBlock* block_;
  std::optional<Polyline> polyline_;
  std::unordered_map<std::string, int> look_of_key_;
};

}  // namespace insitu
