// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/patches.h"

#include <gtest/gtest.h>

#include <map>

namespace insitu {
namespace {

PatchGrid AboutOrigin(double size) {
  return {{Eigen::AlignedBox3d(Eigen::Vector3d::Zero().eval())}, size};
}

SceneGeometry WithSquare(double half, const Eigen::Vector3d& normal) {
  SceneGeometry scene;
  scene.origin.setZero();
  scene.zenith.unit = Eigen::Vector3d::UnitZ();
  Polygon square;
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    square.vertices.push_back(half * (x * u + y * v));
  }
  square.normal = normal;
  scene.polygons = {square};
  return scene;
}

int AddOfPolygon(Patches* patches, int face, bool is_back, const Eigen::Vector3d& position) {
  return patches->AddOfPolygon(face, is_back, patches->grid().At(position));
}

int AddPlanned(Patches* patches, const Eigen::Vector3d& normal, const Eigen::Vector3d& position) {
  return patches->AddPlanned(normal, patches->grid().At(position));
}

TEST(PatchGrid, SizeDoublesWithDistanceFromTheNearestFocus) {
  PatchGrid grid = AboutOrigin(0.5);
  EXPECT_EQ(grid.At({0, 0, 0}).size, 0.5);
  EXPECT_EQ(grid.At({2.4, 0, 0}).size, 0.5);
  EXPECT_EQ(grid.At({2.6, 0, 0}).size, 1);
  EXPECT_EQ(grid.At({0, 5.1, 0}).size, 2);
  grid.foci.emplace_back(Eigen::Vector3d(0, 5, 0), Eigen::Vector3d(0, 6, 0));
  EXPECT_EQ(grid.At({0, 5.1, 0}).size, 0.5);
}

TEST(Patches, APointFindsItsOwnPiece) {
  Patches patches(AboutOrigin(1));
  std::map<int, Eigen::Vector3d> made;
  for (int face = 0; face < 3; ++face) {
    for (const bool is_back : {false, true}) {
      for (int x = -2; x < 2; ++x) {
        const Eigen::Vector3d center(x, 0, 0);
        made[AddOfPolygon(&patches, face, is_back, center)] = center;
        const int own = patches.OfPolygon(face, is_back, center + Eigen::Vector3d(0.3, -0.3, 0.4));
        EXPECT_EQ(own, static_cast<int>(patches.all().size()) - 1);
      }
    }
  }
  EXPECT_EQ(made.size(), 3u * 2 * 4);
  EXPECT_EQ(AddOfPolygon(&patches, 1, false, {0.1, 0.2, 0}),
            patches.OfPolygon(1, false, {0, 0, 0}));
  EXPECT_EQ(patches.all().size(), made.size());
}

TEST(Patches, VoxelsAllAroundTheOriginAreDistinct) {
  Patches patches(AboutOrigin(0.25));
  size_t voxels = 0;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        AddPlanned(&patches, Eigen::Vector3d::UnitX(), 0.25 * Eigen::Vector3d(x, y, z));
        ++voxels;
      }
    }
  }
  EXPECT_EQ(patches.all().size(), voxels);
}

// Planes lie at round coordinates, and rays meet them a hair before or behind.
TEST(Patches, PointsJustOffARoundPlaneShareAPiece) {
  for (const double size : {0.1, 0.25, 0.5, 1.0}) {
    Patches patches(AboutOrigin(size));
    for (const double z : {0.0, 0.5, 1.0, -0.4}) {
      const int piece = AddOfPolygon(&patches, 0, false, {0.02, 0.02, z});
      EXPECT_EQ(AddOfPolygon(&patches, 0, false, {0.02, 0.02, z - 1e-7}), piece)
          << size << ' ' << z;
      EXPECT_EQ(AddOfPolygon(&patches, 0, false, {0.02, 0.02, z + 1e-7}), piece)
          << size << ' ' << z;
    }
  }
}

TEST(Patches, ManyAreFoundAgain) {
  Patches patches(AboutOrigin(0.5));
  std::vector<Eigen::Vector3d> places;
  for (int y = 0; y < 141; ++y) {
    for (int x = 0; x < 141; ++x) places.emplace_back(0.5 * x, 0.5 * y, -0.2);
  }
  std::vector<int> numbers;
  for (const Eigen::Vector3d& place : places)
    numbers.push_back(AddOfPolygon(&patches, 7, true, place));
  for (size_t i = 0; i < places.size(); ++i) {
    ASSERT_EQ(patches.OfPolygon(7, true, places[i]), numbers[i]) << i;
  }
}

TEST(VoxelTable, GrowsAndKeepsItsNumbers) {
  VoxelTable table;
  EXPECT_EQ(table.Find(12), -1);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(table.Insert(64 * static_cast<uint64_t>(i), i), i);
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(table.Find(64 * static_cast<uint64_t>(i)), i);
  EXPECT_EQ(table.Insert(64, 9999), 1);
  EXPECT_EQ(table.Find(63), -1);
}

TEST(Patches, WhereAVoxelHoldsNoneTheNearestOfTheSameFaceStandsIn) {
  Patches patches(AboutOrigin(1));
  for (const double x : {0.5, 3.5}) {
    const int index = AddOfPolygon(&patches, 0, false, {x, 0, 0});
    patches.all()[index].point.position = {x, 0, 0};
  }
  const int other = AddOfPolygon(&patches, 1, false, {5.5, 0, 0});
  patches.all()[other].point.position = {5.5, 0, 0};
  EXPECT_EQ(patches.OfPolygon(0, false, {1.6, 0, 0}), 0);
  EXPECT_EQ(patches.OfPolygon(0, false, {5.6, 0, 0}), 1);
  EXPECT_EQ(patches.OfPolygon(0, true, {0.5, 0, 0}), -1);
  EXPECT_EQ(patches.OfPolygon(2, false, {0.5, 0, 0}), -1);
}

TEST(Patches, PlannedFacesThatLookTheSameWayShareAPiece) {
  Patches patches(AboutOrigin(1));
  const Eigen::Vector3d place(0.5, 0.5, 0.5);
  const int up = AddPlanned(&patches, Eigen::Vector3d::UnitZ(), place);
  EXPECT_EQ(AddPlanned(&patches, Eigen::Vector3d(0.05, 0, 1).normalized(), place), up);
  EXPECT_NE(AddPlanned(&patches, -Eigen::Vector3d::UnitZ(), place), up);
  EXPECT_NE(AddPlanned(&patches, Eigen::Vector3d(1, 0, 1).normalized(), place), up);
  EXPECT_EQ(patches.OfPlanned(Eigen::Vector3d::UnitX(), place), -1);
  EXPECT_EQ(patches.OfPolygon(0, false, place), -1);
}

TEST(GroundPlane, LiesOnTheLevelPolygonBelowTheFocus) {
  const PatchGrid grid{{Eigen::AlignedBox3d(Eigen::Vector3d(2, 3, 4), Eigen::Vector3d(4, 5, 6))},
                       1};
  const SceneGeometry scene = WithSquare(50, Eigen::Vector3d::UnitZ());
  const auto ground = GroundOf(scene, grid);
  ASSERT_TRUE(ground);
  EXPECT_LT((ground->center - Eigen::Vector3d(3, 4, 0)).norm(), 1e-9);
  EXPECT_GE(ground->reach, 50 * std::sqrt(2.0));
  const auto near = ground->Meet(scene, {{0, 0, 2}, Eigen::Vector3d(1, 0, -1).normalized()});
  ASSERT_TRUE(near);
  EXPECT_LT((*near - Eigen::Vector3d(2, 0, 0)).norm(), 1e-9);
  const auto far = ground->Meet(scene, {{0, 0, 2}, Eigen::Vector3d(1, 0, -1e-6).normalized()});
  ASSERT_TRUE(far);
  EXPECT_NEAR((*far - ground->center).norm(), ground->reach, 1e-6);
  EXPECT_FALSE(ground->Meet(scene, {{0, 0, 2}, Eigen::Vector3d::UnitZ()}));
  EXPECT_FALSE(GroundOf(WithSquare(50, Eigen::Vector3d::UnitX()), grid));
}

}  // namespace
}  // namespace insitu
