// SPDX-License-Identifier: GPL-3.0-or-later
// Models of buildings in any format that is read: one face for all importers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/dxf/dxf.h"
#include "renderer/mesh/model.h"

namespace insitu {

enum class ModelFormat { kDxf, kIfc, kGltf, kCollada, kObj, kPly, kStl };

// What a file is by its content, whatever its name ends in; nullopt: nothing that is read.
std::optional<ModelFormat> DetectModelFormat(const std::filesystem::path& path);

// Whether a name ends as models do (.dxf, .ifc, .dwg, .skp, ...), read or not.
bool IsNamedLikeAModel(const std::filesystem::path& path);

struct ImportOptions {
  DxfOptions dxf;
  int seconds = 600;  // a library that takes longer is stopped; of a small file, sooner
};

// Throws InputError: unreadable, a format that is not read (DWG, SketchUp, Rhino, ... are named),
// and what each format's reader states.
Model ReadModel(const std::filesystem::path& path, const ImportOptions& options = {});

}  // namespace insitu
