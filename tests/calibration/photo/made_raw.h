// SPDX-License-Identifier: GPL-3.0-or-later
// A small raw photograph as a camera writes it: a DNG of uncompressed samples under red, green,
// green and blue. [DNG 1.4]
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>

namespace insitu {

struct MadeRaw {
  int width = 64, height = 48;  // [px], even
  // Linear Rec. 709 at (x, y); 1 is white where the first channel clips.
  std::function<Eigen::Vector3d(int x, int y)> scene;
  int orientation = 1;
  bool has_colors = true;  // a matrix; else nobody knows the camera's colours
  uint16_t black = 512, white = 16383;
};

// Camera from XYZ under D65, as the file states it.
Eigen::Matrix3d MadeRawColorMatrix();

void WriteMadeRaw(const std::filesystem::path& path, const MadeRaw& raw);

}  // namespace insitu
