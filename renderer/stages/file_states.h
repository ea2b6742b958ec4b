// SPDX-License-Identifier: GPL-3.0-or-later
// The files that a run is made from, or makes, as a record keeps them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/stages/file_hashes.h"
#include "renderer/stages/stage_record.h"

namespace insitu {

// Of files, and of folders all files below them but hidden ones. Those of the site are named as
// they lie in it, so that it can be moved; what is not there has the hash "".
FileStates StatesOf(const SitePaths& site, const std::vector<std::filesystem::path>& paths,
                    FileHashes* hashes);

// WhatChanged in a line, of many the first four.
std::string ReasonText(const std::vector<std::string>& reasons);

}  // namespace insitu
