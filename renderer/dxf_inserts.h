// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a drawing's blocks can be put where they are inserted at all.
#pragma once

#include "renderer/dxf_drawing.h"

namespace insitu {

// The block that an INSERT names. Throws InputError: the drawing does not define it.
const DxfBlock& InsertedBlock(const DxfDrawing& drawing, const DxfInsert& insert);

// Looks at every block that the model space uses, once. Throws InputError at the INSERT: an unknown
// block, blocks that insert themselves, blocks more than 64 deep, copies that come to over 20
// million pieces (vertices, entities and the copies themselves).
void CheckInserts(const DxfDrawing& drawing);

}  // namespace insitu
