// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/uv_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace insitu {
namespace {

using Eigen::Vector2d;

double AreaOf(const UvMesh& mesh) {
  double area = 0;
  for (const Eigen::Vector3i& t : mesh.triangles()) {
    const Vector2d u = mesh.points()[t[1]] - mesh.points()[t[0]],
                   v = mesh.points()[t[2]] - mesh.points()[t[0]];
    area += (u.x() * v.y() - u.y() * v.x()) / 2;
    EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0);
  }
  return area;
}

// Two rims of many points each, as a cylinder's: triangles are narrow, not fans over the whole.
TEST(UvMesh, KeepsTheRimsAndStaysNarrow) {
  std::vector<Vector2d> points;
  for (int i = 0; i <= 40; ++i) points.emplace_back(i, 0);
  for (int i = 40; i >= 0; --i) points.emplace_back(i, 1);
  std::vector<int> outline(points.size());
  std::iota(outline.begin(), outline.end(), 0);
  const UvMesh mesh(points, outline);
  EXPECT_NEAR(AreaOf(mesh), 40, 1e-9);
  EXPECT_EQ(mesh.triangles().size(), 80u);
  for (const Eigen::Vector3i& t : mesh.triangles()) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(std::abs(points[t[i]].x() - points[t[(i + 1) % 3]].x()), 1);
    }
  }
}

TEST(UvMesh, TakesPointsOnEdgesBetweenTriangles) {
  UvMesh mesh({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {0, 1, 2, 3});
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(2, 2), {1, 1}, {3, 3}, {2, 1}, {2, 3}, {1, 2}, {3, 2}}) {
    mesh.Insert(point);
  }
  EXPECT_EQ(mesh.points().size(), 11u);
  EXPECT_EQ(mesh.triangles().size(), 16u);
  EXPECT_NEAR(AreaOf(mesh), 16, 1e-9);
}

TEST(UvMesh, TakesPointsWithinButNoneOnItsRim) {
  UvMesh mesh({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {0, 1, 2, 3});
  for (double x = 0.37; x < 4; x += 0.53) {
    for (double y = 0.29; y < 4; y += 0.61) mesh.Insert({x, y});
  }
  mesh.Insert({2, 0});
  mesh.Insert({9, 9});
  EXPECT_EQ(mesh.points().size(), 4u + 7 * 7);
  EXPECT_EQ(mesh.triangles().size(), 2u + 2 * 7 * 7);
  EXPECT_NEAR(AreaOf(mesh), 16, 1e-9);
}

TEST(UvMesh, OfAnOutlineThatCrossesItselfHasNoTriangles) {
  EXPECT_TRUE(UvMesh({{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {0, 1, 2, 3}).triangles().empty());
}

}  // namespace
}  // namespace insitu
