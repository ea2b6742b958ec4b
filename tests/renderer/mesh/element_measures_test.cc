// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/element_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insitu {
namespace {

// A tetrahedron of three unit edges on a national grid.
ModelMesh Tetrahedron() {
  const Eigen::Vector3d far(2600000, 1200000, 500);
  ModelMesh mesh;
  mesh.surfaces.resize(1);
  mesh.surfaces[0].layer = "tetra";
  mesh.vertices = {far, far + Eigen::Vector3d::UnitX(), far + Eigen::Vector3d::UnitY(),
                   far + Eigen::Vector3d::UnitZ()};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  mesh.surface_of_triangle = {0, 0, 0, 0};
  return mesh;
}

TEST(ElementMeasures, ClosedElementsHaveAVolume) {
  const auto elements = MeasuresByLayer(Tetrahedron());
  ASSERT_EQ(elements.size(), 1u);
  EXPECT_NEAR(elements.at("tetra").area, 1.5 + std::sqrt(3) / 2, 1e-9);
  EXPECT_NEAR(elements.at("tetra").volume.value(), 1.0 / 6, 1e-9);
  EXPECT_NEAR(Sum(elements).volume.value(), 1.0 / 6, 1e-9);
}

// As kernels give them that place each face on its own.
TEST(ElementMeasures, CornersThatRoundingPartedAreOne) {
  ModelMesh mesh = Tetrahedron();
  for (int t = 0; t < 4; ++t) {
    for (int& corner : mesh.triangles[t]) {
      mesh.vertices.emplace_back(mesh.vertices[corner] + Eigen::Vector3d::Constant(1e-8 * t));
      corner = static_cast<int>(mesh.vertices.size()) - 1;
    }
  }
  EXPECT_NEAR(MeasuresByLayer(mesh).at("tetra").volume.value(), 1.0 / 6, 1e-6);
}

// One side's neighbours are two, as kernels leave it that drop corners on a line.
TEST(ElementMeasures, ASideWithSeveralNeighboursIsClosed) {
  ModelMesh mesh = Tetrahedron();
  mesh.vertices.emplace_back((mesh.vertices[0] + mesh.vertices[1]) / 2);
  mesh.triangles[1] = {0, 4, 3};
  mesh.triangles.emplace_back(4, 1, 3);
  mesh.surface_of_triangle.push_back(0);
  EXPECT_NEAR(MeasuresByLayer(mesh).at("tetra").volume.value(), 1.0 / 6, 1e-9);
  mesh.vertices[4].y() += 1e-3;
  EXPECT_EQ(MeasuresByLayer(mesh).at("tetra").volume, std::nullopt);
  EXPECT_EQ(MeasuresByLayer(mesh).at("tetra").open_edges, 3);
}

TEST(ElementMeasures, OpenOnesHaveNone) {
  ModelMesh mesh = Tetrahedron();
  mesh.triangles.pop_back();
  mesh.surface_of_triangle.pop_back();
  EXPECT_EQ(MeasuresByLayer(mesh).at("tetra").volume, std::nullopt);
  EXPECT_EQ(MeasuresByLayer(mesh).at("tetra").open_edges, 3);
  EXPECT_EQ(Sum(MeasuresByLayer(mesh)).volume, std::nullopt);
}

}  // namespace
}  // namespace insitu
