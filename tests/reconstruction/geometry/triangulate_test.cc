// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/triangulate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

// The sum of the triangles' signed areas about `normal`; every one of them must be positive.
double Area(const std::vector<Vector3d>& vertices, const Vector3d& normal) {
  const auto triangles = Triangulate(vertices, normal);
  if (!triangles) return -1;
  double sum = 0;
  for (const Eigen::Vector3i& t : *triangles) {
    const Vector3d twice = (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]);
    EXPECT_GT(twice.dot(normal), 0);
    sum += twice.dot(normal) / 2;
  }
  return sum;
}

const Vector3d kUp(0, 0, 1);

TEST(Triangulate, CoversAConcaveOutlineExactly) {
  EXPECT_NEAR(Area({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}, kUp), 10, 1e-12);
}

TEST(Triangulate, WindsAboutTheNormalWhateverTheOutlineDoes) {
  EXPECT_NEAR(Area({{0, 4, 0}, {4, 4, 0}, {4, 0, 0}, {0, 0, 0}}, kUp), 16, 1e-12);
}

TEST(Triangulate, PassesCollinearVertices) {
  EXPECT_NEAR(
      Area({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 2, 0}, {1.5, 2, 0}, {0, 2, 0}}, kUp), 6,
      1e-12);
}

TEST(Triangulate, ReachesAHoleThroughADoubleEdge) {
  const std::vector<Vector3d> ring = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                      {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  EXPECT_NEAR(Area(ring, kUp), 12, 1e-12);
}

// A comb: its ears are behind thousands of corners that are none.
TEST(Triangulate, OutlinesOfThousandsOfCornersTakeNoMinutes) {
  std::vector<Vector3d> comb;
  for (int i = 0; i < 3000; ++i) comb.emplace_back(0.001 * i, i % 2, 0);
  for (int i = 2999; i >= 0; --i) comb.emplace_back(0.001 * i, i % 2 + 0.1, 0);
  EXPECT_NEAR(Area(comb, kUp), 0.2999, 1e-9);
}

TEST(Triangulate, RefusesAnOutlineThatCrossesItself) {
  EXPECT_FALSE(Triangulate({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 3, 0}}, kUp));
}

TEST(Triangulate, RefusesAnOutlineWithoutArea) {
  EXPECT_FALSE(Triangulate({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, kUp));
}

TEST(Triangulate, CoversStarsInAnyPlaneOnANationalGrid) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3d normal =
        Vector3d(uniform(generator) - 0.5, uniform(generator) - 0.5, uniform(generator) - 0.5)
            .normalized();
    const Vector3d right = normal.unitOrthogonal(), forward = normal.cross(right);
    std::vector<Vector3d> star;
    double area = 0, radius = 0, last = 0, first = 0;
    const int n = 5 + trial % 20;
    for (int k = 0; k < n; ++k) {
      radius = 1 + 9 * uniform(generator);
      const double angle = 2 * M_PI * k / n;
      star.push_back(Vector3d(2600000, 1200000, 400) +
                     radius * (std::cos(angle) * right + std::sin(angle) * forward));
      if (k == 0) first = radius;
      if (k > 0) area += last * radius * std::sin(2 * M_PI / n) / 2;
      last = radius;
    }
    area += last * first * std::sin(2 * M_PI / n) / 2;
    EXPECT_NEAR(Area(star, normal), area, 1e-6) << "trial " << trial;
  }
}

}  // namespace
}  // namespace insitu
