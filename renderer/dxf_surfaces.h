// SPDX-License-Identifier: GPL-3.0-or-later
// Entities of a drawing that carry surfaces, each added to a model in the drawing's own units.
// All throw InputError at the faulty line.
#pragma once

#include <span>

#include "renderer/dxf.h"
#include "renderer/dxf_record.h"

namespace insitu {

void AddDxf3dFace(const DxfRecord& entity, DxfModel* model);
// SOLID and TRACE: a flat face, or with thickness (group 39) a prism.
void AddDxfSolid(const DxfRecord& entity, DxfModel* model);
void AddDxfMesh(const DxfRecord& entity, DxfModel* model);
// `vertices` are the VERTEX records that follow the POLYLINE.
void AddDxfPolyface(const DxfRecord& polyline, std::span<const DxfRecord> vertices,
                    DxfModel* model);
void AddDxfPolygonMesh(const DxfRecord& polyline, std::span<const DxfRecord> vertices,
                       DxfModel* model);

}  // namespace insitu
