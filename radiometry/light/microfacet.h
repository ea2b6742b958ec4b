// SPDX-License-Identifier: GPL-3.0-or-later
// Rough mirrors: small facets that mirror, and how their normals are distributed. Directions are
// unit, in a frame whose z axis is the mean normal, and point away from the surface.
#pragma once

#include <Eigen/Core>

namespace insitu {

enum class FacetDistribution { kGgx, kBeckmann };

// `slope` is alpha of GGX, or m of Beckmann: the total rms slope, p(slope) ~ exp(-tan^2 / m^2).
// 0: a smooth mirror, for which the functions below are not made.
struct Roughness {
  double slope = 0;  // 0..1
  FacetDistribution distribution = FacetDistribution::kGgx;

  bool operator==(const Roughness&) const = default;
};

// D(m): facet area per solid angle and area of the surface, so that its integral times the cosine
// is 1 [1/sr]. [Walter et al. 2007, Eqs. 25, 33]
double FacetDensity(const Roughness& roughness, const Eigen::Vector3d& facet);

// G1: the share of facets that a direction at this cosine does not see hidden by others; of two
// directions the product counts (separable). [Smith 1967; Walter et al. 2007, Eq. 34]
double SmithMasking(const Roughness& roughness, double cosine);

// Radiance towards `to_viewer` per radiance from `to_light` and solid angle, cosine included, of
// facets that mirror all: D G / (4 cos_o). 0 if one of the two is below the surface [1/sr].
double MirrorLobe(const Roughness& roughness, const Eigen::Vector3d& to_viewer,
                  const Eigen::Vector3d& to_light);

// The normal of a facet that the viewer sees, from a point uniform in [0, 1)^2. The light that it
// mirrors counts SmithMasking of its direction. [Heitz & d'Eon 2014; Heitz 2018]
Eigen::Vector3d VisibleFacet(const Roughness& roughness, const Eigen::Vector3d& to_viewer,
                             const Eigen::Vector2d& uniform);

}  // namespace insitu
