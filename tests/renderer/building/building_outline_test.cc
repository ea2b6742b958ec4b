// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

// On a national grid, as buildings are.
const Vector3d kPlace(2600000, 1200000, 400);

void AddQuad(const std::array<Vector3d, 4>& corners, bool is_turned, ArtificialEnvironment* mesh) {
  const int first = static_cast<int>(mesh->vertices.size());
  for (const Vector3d& corner : corners) mesh->vertices.push_back(kPlace + corner);
  for (const int i : {1, 2}) {
    mesh->triangles.push_back(is_turned ? Vector3i(first, first + i + 1, first + i)
                                        : Vector3i(first, first + i, first + i + 1));
  }
}

// A unit cube whose faces have vertices of their own; one of them may be inside out.
ArtificialEnvironment Cube(bool is_face_turned = false) {
  ArtificialEnvironment cube;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      std::array<Vector3d, 4> corners;
      for (int i = 0; i < 4; ++i) {
        corners[i][axis] = side;
        corners[i][(axis + 1) % 3] = i == 1 || i == 2;
        corners[i][(axis + 2) % 3] = i >= 2;
      }
      AddQuad(corners, (side == 0) != (is_face_turned && axis == 0 && side == 1), &cube);
    }
  }
  return cube;
}

// A ball of radius 1 with `rings` times twice as many faces.
ArtificialEnvironment Ball(int rings) {
  ArtificialEnvironment ball;
  const auto at = [&](int ring, int step) {
    const double polar = std::numbers::pi * ring / rings;
    const double round = std::numbers::pi * (step % (2 * rings)) / rings;
    return Vector3d(std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round),
                    std::cos(polar));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int step = 0; step < 2 * rings; ++step) {
      AddQuad({at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)},
              false, &ball);
    }
  }
  return ball;
}

TEST(BuildingEdges, OutlineOfACubeIsAHexagon) {
  for (const bool is_face_turned : {false, true}) {
    const BuildingEdges edges(Cube(is_face_turned));
    EXPECT_EQ(edges.points().size(), 8u);
    EXPECT_EQ(edges.OutlineFrom(kPlace + Vector3d(9, 7, 5)).size(), 6u);
    EXPECT_EQ(edges.OutlineFrom(kPlace + Vector3d(9, 0.5, 0.5)).size(), 4u);
    EXPECT_EQ(edges.CornersSeenFrom(kPlace + Vector3d(9, 0.5, 0.5)).size(), 8u);
  }
}

TEST(BuildingEdges, OpenFacesAreOutlineAllAround) {
  ArtificialEnvironment plate;
  AddQuad({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(0, 1, 0)}, false,
          &plate);
  EXPECT_EQ(BuildingEdges(plate).OutlineFrom(kPlace + Vector3d(0, 0, -9)).size(), 4u);
}

// 20 000 vertices have a table of a few hundred: those where the line of sight grazes the ball.
TEST(BuildingEdges, OfABallOnlyTheOutlineIsLeft) {
  const BuildingEdges edges(Ball(100));
  const Vector3d eye = kPlace + Vector3d(30, 20, 10);
  const std::vector<Vector3d> corners = edges.CornersSeenFrom(eye);
  EXPECT_GT(edges.points().size(), 19000u);
  EXPECT_GT(corners.size(), 200u);
  EXPECT_LT(corners.size(), 800u);
  for (const Vector3d& corner : corners) {
    const Vector3d out = (corner - kPlace).normalized();
    EXPECT_LT(std::abs(out.dot((eye - corner).normalized())), 0.07);
  }
}

// Lines of sight touch a sphere nearer than its middle.
TEST(BuildingEdges, ASpheresOutlineIsItsSilhouette) {
  ArtificialEnvironment building;
  building.spheres = {{kPlace, 2, 0}};
  const Vector3d eye = kPlace + Vector3d(6, 2, 3);  // 7 m away
  const BuildingEdges edges(building);
  const auto corners = edges.CornersSeenFrom(eye);
  ASSERT_EQ(corners.size(), 16u);
  for (const Vector3d& corner : corners) {
    EXPECT_NEAR((corner - kPlace).norm(), 2, 1e-9);
    EXPECT_NEAR((corner - kPlace).dot(eye - corner), 0, 1e-8);
  }
  const auto outline = edges.OutlineFrom(eye);
  ASSERT_EQ(outline.size(), 128u);
  double length = 0;
  for (const auto& [a, b] : outline) {
    EXPECT_NEAR(((a + b) / 2 - kPlace).norm(), 2, 1e-8);
    length += (b - a).norm();
  }
  EXPECT_NEAR(length, 4 * std::numbers::pi * std::sqrt(1 - 4.0 / 49), 0.003);
  EXPECT_TRUE(edges.OutlineFrom(kPlace + Vector3d(1, 0, 0)).empty());
}

}  // namespace
}  // namespace insitu
