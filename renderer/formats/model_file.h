// SPDX-License-Identifier: GPL-3.0-or-later
// Models of buildings in any format that is read: one face for all importers.
#pragma once

#include <filesystem>

#include "renderer/dxf/dxf.h"
#include "renderer/mesh/model.h"

namespace insitu {

struct ImportOptions {
  DxfOptions dxf;
  int seconds = 600;  // a library that takes longer is stopped; of a small file, sooner

  void Check() const;  // throws CheckError that names the field that is wrong
};

// Throws InputError: what RequireModelFormat and each format's reader state.
Model ReadModel(const std::filesystem::path& path, const ImportOptions& options = {});

}  // namespace insitu
