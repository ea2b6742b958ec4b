// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph that lies in the folder under two names would count twice.
#pragma once

#include <filesystem>
#include <vector>

namespace insitu {

// Throws InputError at a file that is, byte for byte, another of the list, or that cannot be read.
// Only files of one size are read.
void RequireDistinctPhotographs(const std::vector<std::filesystem::path>& photographs);

}  // namespace insitu
