// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive stochastic sampling: where the rays of a pixel go, and when there are enough of them.
// [Durisch92, §7, after Cook 1986]
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace insitu {

constexpr double kSpreadReach = 3.1;

// Facets of a rough mirror that each ray of a pixel looks into: they cost less than rays, which
// also gather what else a pixel is made of. Every fifth point of the sequence is well spread, too
// (every fourth is not), for what rays choose once.
constexpr int kFacetsPerRay = 5;

// The point that comes `steps` later in the sequence that all rays of a pixel take theirs from.
Eigen::Vector2d SpreadAfter(const Eigen::Vector2d& point, int steps);

// Well-spread pseudo-random positions, seeded by the pixel alone.
class PixelSampler {
 public:
  PixelSampler(int x, int y);

  Eigen::Vector2d InPixel(int ray) const;  // offset from the pixel's centre, [-0.5, 0.5)^2
  // Offset [px] as the light of a point spreads over the film: a Gaussian of this sigma [px], cut
  // off at kSpreadReach sigma and so much wider that its variance stays.
  Eigen::Vector2d Spread(int ray, double sigma) const;
  Eigen::Vector2d OnDisc(int ray) const;  // for the sun's disc, [0, 1)^2
  // For the first of a ray's facets of a rough mirror, [0, 1)^2; the others come after it.
  Eigen::Vector2d OnFacet(int ray) const;
  uint64_t Seed(int ray) const;  // for all that is chosen after

 private:
  Eigen::Vector2d pixel_shift_, disc_shift_, facet_shift_;
  uint64_t seed_;
};

// Mean and spread of the colours that the rays of a pixel return, spread in sRGB units.
class ColorStatistics {
 public:
  ColorStatistics() { colors_.reserve(kUsualRays); }
  void Add(const Eigen::Vector3d& linear_rgb);
  // Largest standard error of the mean over the three channels.
  double StandardError() const;

 private:
  static constexpr size_t kUsualRays = 16;
  std::vector<Eigen::Vector3d> colors_;  // most pixels never ask for their spread
};

}  // namespace insitu
