// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings that a drawing refers to (XREF).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/dxf/dxf_contents.h"

namespace insitu {

// The DXF drawing that an external block of the drawing `path` means: of its own name, or saved as
// DXF under it ("C:\CAD\grid.dwg" is grid.dxf). nullopt: none that is DXF.
std::optional<std::filesystem::path> FindExternalDrawing(const std::filesystem::path& path,
                                                         const std::string& name);

// Makes the external blocks of `drawing`, which is the last of `nesting`, hold the drawings that
// they mean; layers and blocks of those are called "grid|WALLS", as CAD programs do. Coordinates
// stay as they are: the INSERT's scale counts alone, units that differ from it are a warning. What
// cannot be read stays external, and says why. `read` reads a drawing with its own references.
void AddExternalDrawings(const std::vector<std::filesystem::path>& nesting,
                         const std::function<DxfDrawing(const std::filesystem::path&)>& read,
                         DxfDrawing* drawing);

}  // namespace insitu
