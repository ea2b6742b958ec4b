// SPDX-License-Identifier: GPL-3.0-or-later
// Rays against polygons, in a few lines of our own: independent of the renderer's.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "datasets_synthetic/scene.h"

namespace insitu::demo {

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // unit
};

struct Hit {
  const Face* face = nullptr;
  double distance = 0;  // [m]
};

// Whether an outline, convex or concave, goes round `point`.
bool Contains(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point);

// Distance to `face`, from either side; nullopt if the ray misses it or starts beyond it.
std::optional<double> Intersect(const Face& face, const Ray& ray);

// The nearest face closer than `limit` [m].
std::optional<Hit> NearestHit(const Scene& scene, const Ray& ray,
                              double limit = std::numeric_limits<double>::infinity());

// Whether any face lies closer than `limit` [m].
bool IsBlocked(const Scene& scene, const Ray& ray,
               double limit = std::numeric_limits<double>::infinity());

}  // namespace insitu::demo
