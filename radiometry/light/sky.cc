// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/sky.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace insitu {
namespace {

constexpr int kBands = 30, kColumns = 4 * kBands;  // of pieces, alike in height and in azimuth
constexpr double kBand = std::numbers::pi / 2 / kBands;  // [rad]
constexpr int kScaleBands = 24, kScaleColumns = 48;      // of equal weight for level ground

// Rows: axes of a frame whose third is the zenith.
Eigen::Matrix3d ZenithFrame(const Eigen::Vector3d& zenith) {
  const Eigen::Vector3d x = zenith.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << x.transpose(), zenith.cross(x).transpose(), zenith.transpose();
  return axes;
}

Eigen::Vector3d AtHeight(double sine, double azimuth) {
  const double cosine = std::sqrt(1 - sine * sine);
  return {cosine * std::cos(azimuth), cosine * std::sin(azimuth), sine};
}

}  // namespace

double SkyGradation(double sine) { return std::log((1 + 2 * std::max(0.0, sine)) / 3); }

double SkyGlow(double cosine) {
  constexpr double kC = 10, kD = -3, kE = 0.45;
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  return std::log(1 + kC * (std::exp(kD * angle) - std::exp(kD * std::numbers::pi / 2)) +
                  kE * cosine * cosine);
}

RelativeSky::RelativeSky(const SkyShape& shape, const Eigen::Vector3d& zenith,
                         const Eigen::Vector3d& sun)
    : shape_(shape), zenith_(zenith), sun_(sun), is_uniform_(shape.IsUniform()) {
  if (is_uniform_) return;
  const Eigen::Matrix3d world = ZenithFrame(zenith).transpose();
  Spectrum sum = Spectrum::Zero();
  for (int band = 0; band < kScaleBands; ++band) {
    for (int column = 0; column < kScaleColumns; ++column) {
      const double azimuth = 2 * std::numbers::pi * (column + 0.5) / kScaleColumns;
      sum += Towards(world * AtHeight(std::sqrt((band + 0.5) / kScaleBands), azimuth));
    }
  }
  scale_ = sum / (kScaleBands * kScaleColumns);
}

Spectrum RelativeSky::Towards(const Eigen::Vector3d& direction) const {
  if (is_uniform_) return Spectrum::Ones();
  const double gradation = SkyGradation(zenith_.dot(direction)),
               glow = SkyGlow(sun_.dot(direction));
  return (shape_.gradation * gradation + shape_.glow * glow).exp() / scale_;
}

SkyPieces::SkyPieces(const RelativeSky& sky, bool is_uniform, const Eigen::Vector3d& zenith)
    : from_world_(ZenithFrame(zenith)) {
  if (is_uniform) {
    relative_ = {Spectrum::Ones()};
    return;
  }
  for (int band = 0; band < kBands; ++band) {
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2 * std::numbers::pi * (column + 0.5) / kColumns;
      relative_.push_back(
          sky.Towards(from_world_.transpose() * AtHeight(std::sin((band + 0.5) * kBand), azimuth)));
    }
  }
}

int SkyPieces::Of(const Eigen::Vector3d& direction) const {
  if (relative_.size() == 1) return 0;
  const Eigen::Vector3d d = from_world_ * direction;
  const double turn = std::atan2(d.y(), d.x()) / (2 * std::numbers::pi);
  const double height = std::asin(std::clamp(d.z(), 0.0, 1.0));
  const int band = std::min(static_cast<int>(height / kBand), kBands - 1);
  const int column = static_cast<int>((turn < 0 ? turn + 1 : turn) * kColumns);
  return band * kColumns + std::min(column, kColumns - 1);
}

}  // namespace insitu
