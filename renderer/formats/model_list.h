// SPDX-License-Identifier: GPL-3.0-or-later
// Which files of building/ are models.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

struct ModelList {
  std::vector<std::filesystem::path> files;  // in the order of their names
  std::vector<std::string> warnings;         // what lies there and is not read
};

// By content; models of formats that are not read, archives and models in folders are
// warnings that say what to do. Throws InputError: no model.
ModelList ListModels(const SitePaths& site);

}  // namespace insitu
