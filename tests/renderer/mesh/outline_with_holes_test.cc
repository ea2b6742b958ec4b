// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/outline_with_holes.h"

#include <gtest/gtest.h>

#include "renderer/mesh/face_triangles.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

// Squares of side `size` in an upright plane, wound either way.
class Squares {
 public:
  std::vector<int> Add(double x, double z, double size, bool turned = false) {
    std::vector<int> corners;
    for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      corners.push_back(static_cast<int>(vertices.size()));
      vertices.emplace_back(x + dx * size, 7, z + dz * size);
    }
    if (turned) std::swap(corners[1], corners[3]);
    return corners;
  }
  std::vector<Vector3d> vertices;
};

double AreaOfFace(const Squares& squares, const std::vector<int>& corners) {
  ModelMesh mesh;
  mesh.vertices = squares.vertices;
  mesh.triangles = FaceTriangles(squares.vertices, corners);
  return AreaOf(mesh);
}

TEST(OutlineWithHoles, GridsOfHolesOfEitherDirection) {
  for (const bool turned : {false, true}) {
    Squares squares;
    const std::vector<int> outline = squares.Add(0, 0, 10);
    std::vector<std::vector<int>> holes;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        holes.push_back(squares.Add(1 + 2 * column, 1 + 2 * row, 1, turned));
      }
    }
    int lost = 0;
    const auto joined = OutlineWithHoles(squares.vertices, outline, holes, &lost);
    EXPECT_EQ(lost, 0);
    EXPECT_NEAR(AreaOfFace(squares, joined), 100 - 16, 1e-9);
  }
}

TEST(OutlineWithHoles, OfNoAreaAreLost) {
  Squares squares;
  const std::vector<int> outline = squares.Add(0, 0, 10);
  int lost = 0;
  const auto joined = OutlineWithHoles(squares.vertices, outline, {{0, 1}}, &lost);
  EXPECT_EQ(lost, 1);
  EXPECT_EQ(joined, outline);
}

}  // namespace
}  // namespace insitu
