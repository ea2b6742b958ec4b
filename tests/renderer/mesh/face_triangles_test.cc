// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/face_triangles.h"

#include <gtest/gtest.h>

#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

TEST(FaceTriangles, QuadrangleSplitsAlongTheShorterDiagonal) {
  const std::vector<Vector3d> folded = {{0, 0, 0}, {3, 0, 0}, {4, 1, 1}, {0, 1, 0}};
  const auto triangles = FaceTriangles(folded, {0, 1, 2, 3});
  ASSERT_EQ(triangles.size(), 2u);
  EXPECT_EQ(triangles[0], Eigen::Vector3i(1, 2, 3));
  EXPECT_EQ(triangles[1], Eigen::Vector3i(1, 3, 0));
}

// The shorter diagonal of this dart lies outside it.
TEST(FaceTriangles, DartStaysInsideItsOutline) {
  const std::vector<Vector3d> dart = {{-1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 10, 0}};
  ModelMesh mesh;
  mesh.vertices = dart;
  mesh.triangles = FaceTriangles(dart, {0, 1, 2, 3});
  EXPECT_NEAR(AreaOf(mesh), 9, 1e-14);
  for (const auto& t : mesh.triangles) EXPECT_TRUE((t.array() == 1).any());
}

}  // namespace
}  // namespace insitu
