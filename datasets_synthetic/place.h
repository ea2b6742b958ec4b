// SPDX-License-Identifier: GPL-3.0-or-later
// A site with the building and the light of its day, and what single rays meet in it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "datasets_synthetic/made_site.h"
#include "datasets_synthetic/ray_cast.h"
#include "datasets_synthetic/spectral_light.h"

namespace insitu::demo {

inline constexpr double kSunDiameter = 0.53 * 3.14159265358979 / 180;  // [rad]
inline constexpr double kLift = 1e-6;  // [m], keeps a ray off the face it starts on

// What one picture needs. The building may be empty.
struct Place {
  const Site* site;
  Scene building;
  Daylight daylight;
};

// Two numbers that depend on whether the building stands.
struct BeforeAfter {
  double before = 0, after = 0;
};

// A point on a face, as one sight sees it.
struct Spot {
  const Face* face;
  Eigen::Vector3d point;   // lifted towards the viewer
  Eigen::Vector3d normal;  // towards the viewer
  double distance;         // [m]
  bool on_building;
};

// What a ray meets without the building, and what with it; nullopt: sky.
struct Sighting {
  std::optional<Spot> before, after;
};

// What a camera sees, far ground and hills included.
Sighting Look(const Place& place, const Ray& ray);

// What lights a surface: hills are too far to count, far ground counts.
Sighting LookForLight(const Place& place, const Ray& ray);

// `strata` x `strata` unit directions about `normal`, as dense as the cosine, jittered by `seed`.
std::vector<Eigen::Vector3d> CosineDirections(const Eigen::Vector3d& normal, int strata,
                                              uint64_t seed);

// The visible share of the sun's disc, 0..1, 0 on surfaces turned away and under an overcast sky.
BeforeAfter VisibleSun(const Place& place, const Eigen::Vector3d& point,
                       const Eigen::Vector3d& normal, uint64_t seed);

}  // namespace insitu::demo
