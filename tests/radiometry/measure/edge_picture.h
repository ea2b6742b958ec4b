// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph of one straight edge between two grey halves, blurred by a known Gaussian.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "calibration/photo/photograph.h"
#include "radiometry/measure/edge_spread.h"

namespace insitu {

struct EdgePicture {
  double angle = 0.1;  // [rad], of the edge against the rows
  double sigma = 0.6;  // [px]
  double noise = 0;    // standard deviation
  double dark = 0.2, bright = 0.7;

  static constexpr int kSize = 161;  // [px]

  EdgePiece Piece(double length) const {
    const Eigen::Vector2d middle(80.3, 79.6), along(std::cos(angle), std::sin(angle));
    return {middle - length / 2 * along, middle, middle + length / 2 * along};
  }
  // 32-bit values without a curve.
  Photograph Draw() const {
    Photograph photo{Raster(kSize, kSize), Encoding::kLinear};
    std::mt19937 generator(7);
    std::normal_distribution<double> normal(0, noise);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double across = -std::sin(angle) * (x - 80.3) + std::cos(angle) * (y - 79.6);
        const double share =
            sigma > 0 ? 0.5 * std::erfc(-across / (sigma * std::numbers::sqrt2)) : across > 0;
        const double value = dark + (bright - dark) * share + (noise > 0 ? normal(generator) : 0);
        photo.linear.SetRgb(x, y, Eigen::Vector3d::Constant(std::max(0.0, value)));
      }
    }
    return photo;
  }
};

}  // namespace insitu
