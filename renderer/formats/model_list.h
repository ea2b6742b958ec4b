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
  std::vector<std::string> warnings;         // files that are the same model in another format
};

// By content; files that are neither models nor named like one are passed over.
// Throws InputError: no model, a file that is named like a model but is of a format not read.
ModelList ListModels(const SitePaths& site);

}  // namespace insitu
