// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/sphere_facets.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <random>
#include <utility>

namespace insitu {
namespace {

using Eigen::Vector3d;

TEST(SphereFacets, AreClosedAndLookOutwards) {
  const SphereFacets facets = UnitSphereFacets(3);
  ASSERT_EQ(static_cast<int>(facets.triangles.size()), SphereFacetCount(3));
  EXPECT_EQ(facets.vertices.size(), facets.triangles.size() / 2 + 2);  // Euler
  std::map<std::pair<int, int>, int> passes;
  for (const Eigen::Vector3i& t : facets.triangles) {
    const Vector3d &a = facets.vertices[t[0]], &b = facets.vertices[t[1]],
                   &c = facets.vertices[t[2]];
    EXPECT_GT((b - a).cross(c - a).dot(a + b + c), 0);
    for (int i = 0; i < 3; ++i) ++passes[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : passes) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(passes.count({edge.second, edge.first}), 1u);
  }
}

TEST(SphereFacets, TheFacetTowardsADirectionIsWhereItsRadiusPasses) {
  const SphereFacets facets = UnitSphereFacets(4);
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d direction =
        Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
    const SpherePlace place = FacetTowards(direction, 4);
    const Eigen::Vector3i& t = facets.triangles[place.facet];
    EXPECT_GE(place.uv.minCoeff(), 0);
    EXPECT_LE(place.uv.sum(), 1 + 1e-12);
    const Vector3d at = (1 - place.uv.sum()) * facets.vertices[t[0]] +
                        place.uv.x() * facets.vertices[t[1]] + place.uv.y() * facets.vertices[t[2]];
    EXPECT_LT((at.normalized() - direction).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace insitu
