// SPDX-License-Identifier: GPL-3.0-or-later
// A DXF drawing as it stands in the file, with those that it refers to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/dxf/dxf_contents.h"

namespace insitu {

// What a user calls a block: its name, of a state of a dynamic block that block's; empty: nothing.
std::string NameByUser(const DxfDrawing& drawing, const std::string& block);

// The block that an INSERT names. Throws InputError: the drawing does not define it.
const DxfBlock& InsertedBlock(const DxfDrawing& drawing, const DxfInsert& insert);

// With the drawings that it refers to, sought about `beside`, which stands for `path`.
// Throws InputError: a section that is not closed, a faulty entity; and, among the
// blocks that the model space uses, one that lies more than 64 deep,
// or copies that come to over `most_pieces` (vertices, entities and the copies themselves).
DxfDrawing ReadDxfDrawing(const std::filesystem::path& path, double most_pieces,
                          const std::filesystem::path& beside);

// The DXF drawings that a drawing refers to, where they are there. Throws InputError as above.
std::vector<std::filesystem::path> ExternalDrawingsOf(const std::filesystem::path& path);

}  // namespace insitu
