// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/face_mesh.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

using Eigen::Vector3d;

// Catmull and Clark: a cube of side 2 tends to a body of about 40 % of its volume, whose vertices
// after one step are known: corner (1, 1, 1) moves to 5/9 of itself.
TEST(FaceMesh, SmoothedCube) {
  FaceMesh cube;
  for (int i = 0; i < 8; ++i) {
    cube.vertices.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  }
  cube.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const FaceMesh smooth = Smoothed(cube);
  EXPECT_EQ(smooth.faces.size(), 24u);
  EXPECT_EQ(smooth.vertices.size(), 26u);
  EXPECT_NEAR((smooth.vertices[7] - Vector3d::Constant(5.0 / 9)).norm(), 0, 1e-12);
  for (int a = 0; a < 8; ++a) {
    for (const int bit : {1, 2, 4}) {
      if (!(a & bit)) cube.creases[{a, a | bit}] = 5;
    }
  }
  EXPECT_EQ(Smoothed(cube).vertices[7], Vector3d(1, 1, 1));  // every edge stays sharp
}

}  // namespace
}  // namespace insitu
