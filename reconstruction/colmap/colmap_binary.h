// SPDX-License-Identifier: GPL-3.0-or-later
// The binary form of COLMAP's model files.
#pragma once

#include <filesystem>

#include "reconstruction/colmap/colmap_files.h"

namespace insitu {

// Throws InputError. References between the files are not checked: ReadColmapModel does.
ColmapFiles ReadColmapBinaryFiles(const std::filesystem::path& folder);

// Three files, whole or not at all, that every COLMAP reads.
void WriteColmapBinary(const std::filesystem::path& folder, const ColmapModel& model);

}  // namespace insitu
