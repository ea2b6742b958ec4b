// SPDX-License-Identifier: GPL-3.0-or-later
// From the records of a block, or of the model space, to what it holds.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "renderer/dxf/dxf_block.h"
#include "renderer/dxf/dxf_path.h"
#include "renderer/dxf/dxf_record.h"

namespace insitu {

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

  void Begin(const DxfRecord& record);
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
