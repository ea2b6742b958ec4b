// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/photo/photograph.h"
#include "radiometry/light/split_mix.h"

namespace insitu {
namespace {

double UnitInterval(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// The R2 sequence of Roberts (2018), shifted modulo 1.
Eigen::Vector2d SpreadPoint(const Eigen::Vector2d& shift, int index) {
  constexpr double kGolden = 1.32471795724474602596;  // real root of x^3 = x + 1
  const double a = shift.x() + index / kGolden;
  const double b = shift.y() + index / (kGolden * kGolden);
  return {a - std::floor(a), b - std::floor(b)};
}

}  // namespace

Eigen::Vector2d SpreadAfter(const Eigen::Vector2d& point, int steps) {
  return SpreadPoint(point, steps);
}

PixelSampler::PixelSampler(int x, int y) {
  uint64_t state = SplitMix64(static_cast<uint64_t>(y) << 32 | static_cast<uint32_t>(x));
  const auto next = [&state] { return UnitInterval(state = SplitMix64(state)); };
  pixel_shift_.x() = next();
  pixel_shift_.y() = next();
  disc_shift_.x() = next();
  disc_shift_.y() = next();
  facet_shift_.x() = next();
  facet_shift_.y() = next();
  seed_ = SplitMix64(state);
}

Eigen::Vector2d PixelSampler::InPixel(int ray) const {
  return SpreadPoint(pixel_shift_, ray) - Eigen::Vector2d::Constant(0.5);
}

Eigen::Vector2d PixelSampler::Spread(int ray, double sigma) const {
  // By radius: of a Gaussian of unit variance cut off at c, exp(-c^2/2) = 0.0111 is missing, and
  // its variance is 1 - c^2/2 * 0.0111 / (1 - 0.0111).
  constexpr double kCut = 3, kMissing = 0.011108996538242306;
  static const double kWider = 1 / std::sqrt(1 - kCut * kCut / 2 * kMissing / (1 - kMissing));
  static_assert(kCut * 1.027 < kSpreadReach);
  const Eigen::Vector2d point = SpreadPoint(pixel_shift_, ray);
  const double radius = kWider * sigma * std::sqrt(-2 * std::log(1 - point.x() * (1 - kMissing)));
  const double angle = 2 * std::numbers::pi * point.y();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Eigen::Vector2d PixelSampler::OnDisc(int ray) const { return SpreadPoint(disc_shift_, ray); }

Eigen::Vector2d PixelSampler::OnFacet(int ray) const {
  return SpreadPoint(facet_shift_, ray * kFacetsPerRay);
}

uint64_t PixelSampler::Seed(int ray) const { return SplitMix64(seed_ + ray); }

void ColorStatistics::Add(const Eigen::Vector3d& linear_rgb) { colors_.push_back(linear_rgb); }

double ColorStatistics::StandardError() const {
  Eigen::Array3d sum = Eigen::Array3d::Zero(), sum_of_squares = Eigen::Array3d::Zero();
  for (const Eigen::Vector3d& linear_rgb : colors_) {
    Eigen::Array3d encoded;
    for (int c = 0; c < 3; ++c) encoded[c] = SrgbFromLinear(std::clamp(linear_rgb[c], 0.0, 1.0));
    sum += encoded;
    sum_of_squares += encoded.square();
  }
  const auto count = static_cast<double>(colors_.size());
  const Eigen::Array3d mean = sum / count;
  const Eigen::Array3d variance = (sum_of_squares / count - mean.square()).max(0);
  return std::sqrt(variance.maxCoeff() / (count - 1));
}

}  // namespace insitu
