// SPDX-License-Identifier: GPL-3.0-or-later
// Entities of a drawing that carry surfaces, each added to a block in its own coordinates.
// All throw InputError at the faulty place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "renderer/dxf/dxf_block.h"
#include "renderer/dxf/dxf_record.h"

namespace insitu {

// Adds vertices and returns the index of the first.
int AddDxfVertices(const std::vector<Eigen::Vector3d>& vertices, DxfBlock* block);
// `corners` count from vertex `first` of the block.
void AddDxfFace(int look, int first, std::vector<int> corners, DxfBlock* block);

void AddDxf3dFace(const DxfRecord& entity, int look, DxfBlock* block);
// SOLID and TRACE: a flat face, or with thickness (group 39) a prism.
void AddDxfSolid(const DxfRecord& entity, int look, DxfBlock* block);
// MESH, smoothed as often as its level says (Catmull and Clark 1978).
void AddDxfMesh(const DxfRecord& entity, int look, DxfBlock* block);

// Corners of a polyface's face record, from 0; those of no vertex are left out.
std::vector<int> DxfPolyfaceCorners(const DxfRecord& face, int64_t vertices);

struct DxfGrid {
  int rows, columns;  // of vertices, row by row
  bool closed_along_rows, closed_along_columns;
};
void AddDxfGrid(const DxfGrid& grid, const std::vector<Eigen::Vector3d>& vertices, int look,
                DxfBlock* block);

// Lines as paths; their look is not set.
DxfPath DxfLinePath(const DxfRecord& entity);
DxfPath DxfArcPath(const DxfRecord& entity);  // ARC and CIRCLE
DxfPath DxfLwPolylinePath(const DxfRecord& entity);

}  // namespace insitu
