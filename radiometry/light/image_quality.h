// SPDX-License-Identifier: GPL-3.0-or-later
// How a photograph draws what reaches it: its point spread and its grain.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace insitu {

// A round Gaussian that stands for lens, pixel, demosaicing and sharpening together. Its variance
// grows with the square of the distance from the photograph's centre.
struct PointSpread {
  double center_sigma = 0;  // [px], > 0
  double corner_sigma = 0;  // [px], > 0, half the diagonal from the centre
  double sigma_error = 0;   // [px], standard deviation of sigma amid the edges
  int edges = 0;            // pieces of surveyed edges that tell it

  // [px], at a pixel of a photograph of this size.
  double SigmaAt(const Eigen::Vector2d& pixel, int width, int height) const;
};

// Noise of a photograph in linear light: normal, of a variance that is linear in the radiance.
struct Grain {
  Eigen::Vector3d floor = Eigen::Vector3d::Zero();  // variance at radiance 0, >= 0, by channel
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  // variance per radiance, >= 0
  double length = 0;  // [px], sigma of the Gaussian that white noise is smoothed with
  double shared = 0;  // 0 to 1, correlation of the channels
  int patches = 0;    // even places of the photograph that tell it

  Eigen::Vector3d Variance(const Eigen::Vector3d& linear_rgb) const;
};

struct ImageQuality {
  std::optional<PointSpread> point_spread;  // nullopt: too few edges tell it
  std::optional<Grain> grain;               // nullopt: too few even places tell it
};

// A sample of the grain's noise at a pixel, of unit variance in each channel: a function of pixel,
// `seed` and the grain's correlations alone.
Eigen::Vector3d UnitGrain(const Grain& grain, int x, int y, uint64_t seed);

}  // namespace insitu
