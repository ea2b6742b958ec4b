// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/image_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiometry/light/split_mix.h"

namespace insitu {
namespace {

double OpenUnitInterval(uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; }

// Four independent standard normal numbers of a pixel: one shared by the channels, one for each.
// [Box & Muller 1958]
Eigen::Vector4d WhiteNoise(int x, int y, uint64_t seed) {
  uint64_t state =
      SplitMix64(seed ^ SplitMix64(static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32 |
                                   static_cast<uint32_t>(x)));
  const auto next = [&state] { return OpenUnitInterval(state = SplitMix64(state)); };
  Eigen::Vector4d normal;
  for (int pair = 0; pair < 4; pair += 2) {
    const double radius = std::sqrt(-2 * std::log(next()));
    const double angle = 2 * std::numbers::pi * next();
    normal[pair] = radius * std::cos(angle);
    normal[pair + 1] = radius * std::sin(angle);
  }
  return normal;
}

}  // namespace

double PointSpread::SigmaAt(const Eigen::Vector2d& pixel, int width, int height) const {
  const Eigen::Vector2d half(width / 2.0, height / 2.0);
  const Eigen::Vector2d from_center = pixel + Eigen::Vector2d::Constant(0.5) - half;
  const double share = std::min(1.0, from_center.squaredNorm() / half.squaredNorm());
  const double center = center_sigma * center_sigma, corner = corner_sigma * corner_sigma;
  return std::sqrt(center + share * (corner - center));
}

Eigen::Vector3d Grain::Variance(const Eigen::Vector3d& linear_rgb) const {
  return floor + slope.cwiseProduct(linear_rgb.cwiseMax(0));
}

Eigen::Vector3d UnitGrain(const Grain& grain, int x, int y, uint64_t seed) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  double weight_square = 0;
  const int reach = static_cast<int>(std::ceil(3 * grain.length));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double square = dx * dx + dy * dy;
      const double weight = reach == 0 ? 1 : std::exp(-square / (2 * grain.length * grain.length));
      sum += weight * WhiteNoise(x + dx, y + dy, seed);
      weight_square += weight * weight;
    }
  }
  sum /= std::sqrt(weight_square);
  return std::sqrt(grain.shared) * Eigen::Vector3d::Constant(sum[0]) +
         std::sqrt(1 - grain.shared) * sum.tail<3>();
}

}  // namespace insitu
