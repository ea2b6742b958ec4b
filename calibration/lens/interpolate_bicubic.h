// SPDX-License-Identifier: GPL-3.0-or-later
// Between the pixels of a photograph that is resampled.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "calibration/lens/catmull_rom.h"
#include "calibration/photo/raster.h"

namespace insitu {

// Catmull-Rom; positions beyond the outermost centres take the nearest value. Light is never
// negative, so neither is the curve between bright and dark.
inline Eigen::Vector3d InterpolateBicubic(const Raster& image, const Eigen::Vector2d& pixel) {
  const int x0 = static_cast<int>(std::floor(pixel.x()));
  const int y0 = static_cast<int>(std::floor(pixel.y()));
  const auto across = CatmullRomWeights(pixel.x() - x0);
  const auto down = CatmullRomWeights(pixel.y() - y0);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < 4; ++j) {
    const int y = std::clamp(y0 - 1 + j, 0, image.height - 1);
    for (int i = 0; i < 4; ++i) {
      const int x = std::clamp(x0 - 1 + i, 0, image.width - 1);
      sum += down[j] * across[i] * image.Rgb(x, y);
    }
  }
  return sum.cwiseMax(0);
}

}  // namespace insitu
