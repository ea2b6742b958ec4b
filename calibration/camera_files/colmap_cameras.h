// SPDX-License-Identifier: GPL-3.0-or-later
// COLMAP's cameras.txt. [colmap.github.io/format.html, cameras.html, src/colmap/sensor/models.h]
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "calibration/files/error.h"
#include "calibration/lens/colmap_lens.h"

namespace insitu {

struct ColmapCamera {
  ColmapLens lens;  // of one of ColmapLensModels(), with as many parameters
  FilePlace place;
};

// By id. Throws InputError: unreadable, fewer cameras than its head says, an unknown lens model, a
// frame without pixels, a number that is none, more or fewer parameters than the model has, an id
// twice. As a camera file: ReadColmapCamera of camera_file_formats.h.
std::map<uint32_t, ColmapCamera> ReadColmapCameras(const std::filesystem::path& path);

// Whose camera each is: ids in cameras.txt by the images' file names, without folders and ending,
// of a model's images.txt. Throws InputError: unreadable, an id that is none, a name twice.
std::map<std::string, uint32_t> ReadColmapCameraOfImages(const std::filesystem::path& path);

}  // namespace insitu
