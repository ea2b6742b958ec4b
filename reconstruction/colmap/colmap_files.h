// SPDX-License-Identifier: GPL-3.0-or-later
// What both forms of COLMAP's model files hold, and where in them each thing stands.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "calibration/files/error.h"
#include "reconstruction/colmap/colmap_model.h"

namespace insitu {

// A model with the place of each of its entries: a line of a text file, an offset of a binary one.
struct ColmapFiles {
  std::filesystem::path cameras_path, images_path, points_path;
  bool is_binary = false;
  ColmapModel model;
  std::map<uint64_t, size_t> place_of_image, place_of_point;
};

// An error at a line, or at an offset in bytes.
InputError ColmapError(const std::filesystem::path& path, bool is_binary, size_t place,
                       const std::string& message);

}  // namespace insitu
