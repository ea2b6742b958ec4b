// SPDX-License-Identifier: GPL-3.0-or-later
// Facets that stand for a sphere where places on it are counted by triangles: the octahedron's
// faces, each quartered `level` times, its new corners put onto the sphere.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {

constexpr int kFinestSphereLevel = 8;

constexpr int SphereFacetCount(int level) { return 8 << 2 * level; }

struct SphereFacets {
  std::vector<Eigen::Vector3d> vertices;   // unit; those of the axes among them
  std::vector<Eigen::Vector3i> triangles;  // counter-clockwise seen from outside
};

// The facet below a point of the sphere, and where on it the radius passes.
struct SpherePlace {
  int facet = 0;
  Eigen::Vector2d uv;  // barycentric weights of its second and third corner
};
namespace sphere_facets {

using Directions = std::array<Eigen::Vector3d, 3>;

inline constexpr int kOctants = 8;

inline Directions OctantCorners(int octant) {
  const auto sign = [&](int axis) { return (octant >> axis & 1) != 0 ? -1.0 : 1.0; };
  const Eigen::Vector3d x = sign(0) * Eigen::Vector3d::UnitX(),
                        y = sign(1) * Eigen::Vector3d::UnitY(),
                        z = sign(2) * Eigen::Vector3d::UnitZ();
  if (sign(0) * sign(1) * sign(2) > 0) return {x, y, z};
  return {x, z, y};
}

// Those at its corners, then the one in the middle.
inline std::array<Directions, 4> Quarters(const Directions& corners) {
  const auto& [a, b, c] = corners;
  const Eigen::Vector3d ab = (a + b).normalized(), bc = (b + c).normalized(),
                        ca = (c + a).normalized();
  return {Directions{a, ab, ca}, Directions{ab, b, bc}, Directions{ca, bc, c},
          Directions{ab, bc, ca}};
}

// On which side of the planes through the middles of the sides.
inline int QuarterTowards(const std::array<Directions, 4>& quarters,
                          const Eigen::Vector3d& direction) {
  const auto& [ab, bc, ca] = quarters[3];
  if (direction.dot(ab.cross(ca)) > 0) return 0;
  if (direction.dot(bc.cross(ab)) > 0) return 1;
  return direction.dot(ca.cross(bc)) > 0 ? 2 : 3;
}

struct FacetBuilder {
  std::map<std::array<double, 3>, int> index_of;
  SphereFacets facets;

  int IndexOf(const Eigen::Vector3d& vertex) {
    const auto [found, is_new] = index_of.try_emplace({vertex.x(), vertex.y(), vertex.z()},
                                                      static_cast<int>(facets.vertices.size()));
    if (is_new) facets.vertices.push_back(vertex);
    return found->second;
  }
  void Add(const Directions& corners, int level) {
    if (level == 0) {
      const int a = IndexOf(corners[0]), b = IndexOf(corners[1]), c = IndexOf(corners[2]);
      facets.triangles.emplace_back(a, b, c);
      return;
    }
    for (const Directions& quarter : Quarters(corners)) Add(quarter, level - 1);
  }
};

}  // namespace sphere_facets

// Of the unit sphere about the origin; `level` 0 to kFinestSphereLevel.
inline SphereFacets UnitSphereFacets(int level) {
  INSITU_CHECK(level >= 0 && level <= kFinestSphereLevel);
  sphere_facets::FacetBuilder builder;
  for (int octant = 0; octant < sphere_facets::kOctants; ++octant)
    builder.Add(sphere_facets::OctantCorners(octant), level);
  return std::move(builder.facets);
}

inline SpherePlace FacetTowards(const Eigen::Vector3d& direction, int level) {
  int facet = 0;
  for (int axis = 0; axis < 3; ++axis) facet |= direction[axis] < 0 ? 1 << axis : 0;
  sphere_facets::Directions corners = sphere_facets::OctantCorners(facet);
  for (int i = 0; i < level; ++i) {
    const std::array<sphere_facets::Directions, 4> quarters = sphere_facets::Quarters(corners);
    const int quarter = sphere_facets::QuarterTowards(quarters, direction);
    corners = quarters[quarter];
    facet = 4 * facet + quarter;
  }
  Eigen::Matrix3d basis;
  basis << corners[0], corners[1], corners[2];
  const Eigen::Vector3d weights = (basis.inverse() * direction).cwiseMax(0);
  return {facet, weights.tail<2>() / weights.sum()};
}

}  // namespace insitu
