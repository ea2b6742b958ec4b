// SPDX-License-Identifier: GPL-3.0-or-later
// Which format the model of a building is in.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insitu {

enum class ModelFormat { kDxf, kIfc, kGltf, kCollada, kObj, kPly, kStl, kObjects };

// What a file is by its content, whatever its name ends in; nullopt: nothing that is read. Throws
// InputError: unreadable.
std::optional<ModelFormat> DetectModelFormat(const std::filesystem::path& path);

// Whether a name ends as models that are read do (.dxf, .ifc, ...).
bool IsNamedLikeAModel(const std::filesystem::path& path);

// What a file of a known format that is not read is, and how to make one that is: "a DWG drawing:
// save it as DXF"; empty: unknown. Throws InputError: unreadable.
std::string AdviceOnUnread(const std::filesystem::path& path);

// The format whose reader is to be asked. Throws InputError: unreadable, a format that is not read
// (DWG, SketchUp, Rhino, ... are named).
ModelFormat RequireModelFormat(const std::filesystem::path& path);

}  // namespace insitu
