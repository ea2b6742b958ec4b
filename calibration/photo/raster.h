// SPDX-License-Identifier: GPL-3.0-or-later
// An image in memory: linear, scene-referred, Rec. 709 primaries unless its owner says otherwise.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

struct Raster {
  Raster() = default;
  Raster(int width_px, int height_px, int channel_count = 3)
      : width(width_px),
        height(height_px),
        channels(channel_count),
        data(static_cast<size_t>(width_px) * height_px * channel_count) {}

  int width = 0;     // [px]
  int height = 0;    // [px]
  int channels = 3;  // interleaved
  std::vector<float> data;

  float* At(int x, int y) { return &data[(static_cast<size_t>(y) * width + x) * channels]; }
  const float* At(int x, int y) const {
    return &data[(static_cast<size_t>(y) * width + x) * channels];
  }
  Eigen::Vector3d Rgb(int x, int y) const {
    const float* p = At(x, y);
    return {p[0], p[1], p[2]};
  }
  void SetRgb(int x, int y, const Eigen::Vector3d& rgb) {
    for (int c = 0; c < 3; ++c) At(x, y)[c] = static_cast<float>(rgb[c]);
  }
};

// The reconstructed image function [Durisch92, §6.2]: bilinear between pixel centres; positions
// beyond the outermost centres take the nearest value. Three channels.
Eigen::Vector3d Interpolate(const Raster& image, const Eigen::Vector2d& pixel);

}  // namespace insitu
