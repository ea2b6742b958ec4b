// SPDX-License-Identifier: GPL-3.0-or-later
// Which files of building/ are models.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

struct ModelList {
  std::vector<std::filesystem::path> files;   // in the order of their names
  std::vector<std::string> warnings;          // what lies there and is not read
  std::vector<std::filesystem::path> others;  // of no known kind, folders too: see UnreadFiles
};

// By content; models of formats that are not read, archives and models in folders are
// warnings that say what to do. Throws InputError: no model.
ModelList ListModels(const SitePaths& site);

// What no model read nor materials.json or lights.json name, of `others`, as one warning; empty:
// nothing. `read` are the files that the models named and that were found.
std::string UnreadFiles(const SitePaths& site, const std::vector<std::filesystem::path>& others,
                        const std::vector<std::filesystem::path>& read);

}  // namespace insitu
