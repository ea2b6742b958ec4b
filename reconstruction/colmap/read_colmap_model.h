// SPDX-License-Identifier: GPL-3.0-or-later
// A sparse model of COLMAP from its folder, whichever form it has.
#pragma once

#include <filesystem>

#include "reconstruction/colmap/colmap_model.h"

namespace insitu {

// Whether a folder holds cameras, images and points3D, as .bin or as .txt.
bool HasColmapModel(const std::filesystem::path& folder);

// Reads cameras, images and points3D of a folder. If all three exist as .bin these are read, as
// COLMAP does, else the .txt. rigs and frames of COLMAP 3.12 and later are not needed: poses of
// images stand in both generations. Throws InputError with file and line, or offset in a binary
// file: a file missing or cut short, an unknown lens model, a number that is none, an id twice, a
// reference to what the model does not hold.
ColmapModel ReadColmapModel(const std::filesystem::path& folder);

}  // namespace insitu
