// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/ray_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <span>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

// A square of side 2 at z = 3 about the z axis, in two triangles.
TriangleMesh Ceiling() {
  return {{{-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}}, {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh RandomTriangles(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal;
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f middle =
        20 * Eigen::Vector3f(normal(generator), normal(generator), normal(generator)).normalized();
    for (int k = 0; k < 3; ++k) {
      mesh.vertices.push_back(
          middle + 3 * Eigen::Vector3f(normal(generator), normal(generator), normal(generator)));
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

TEST(RayScene, HitsAtTheClosedFormPlace) {
  const RayScene scene(Ceiling());
  const Vector3d direction = Vector3d(0.2, -0.1, 1).normalized();
  const auto hit = scene.Nearest({Vector3d::Zero(), direction});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 3 / direction.z(), 1e-6);
  EXPECT_EQ(hit->triangle, 0);
  // (0.6, -0.3, 3) = corner 0 + u (2, 0, 0) + v (2, 2, 0)
  EXPECT_NEAR(hit->uv.y(), 0.35, 1e-6);
  EXPECT_NEAR(hit->uv.x(), 0.45, 1e-6);
}

// The ceiling and a ball before it whose facets are the mesh's last triangles.
TriangleMesh CeilingAndBall(const Vector3d& center, double radius) {
  TriangleMesh mesh = Ceiling();
  mesh.spheres = {{center, radius, static_cast<int>(mesh.triangles.size())}};
  const int first = static_cast<int>(mesh.vertices.size());
  const SphereFacets unit = UnitSphereFacets(kSphereLevel);
  for (const Vector3d& vertex : unit.vertices) {
    mesh.vertices.push_back((center + radius * vertex).cast<float>());
  }
  for (const Eigen::Vector3i& facet : unit.triangles) {
    mesh.triangles.push_back(facet + Eigen::Vector3i::Constant(first));
  }
  return mesh;
}

TEST(RayScene, SpheresAreMetExactlyFromOutsideAndWithin) {
  const Vector3d center(0.1, -0.2, 1.7);
  const RayScene scene(CeilingAndBall(center, 0.4));
  for (const double across : {0.0, 0.1, 0.3, 0.39, 0.3999}) {
    const Ray ray{center + Vector3d(across, 0, -1), Vector3d::UnitZ()};
    const auto hit = scene.Nearest(ray);
    ASSERT_TRUE(hit && hit->sphere_normal);
    const double half = std::sqrt(0.16 - across * across);
    EXPECT_NEAR(hit->distance, 1 - half, 1e-12);
    EXPECT_LT((*hit->sphere_normal - Vector3d(across, 0, -half) / 0.4).norm(), 1e-12);
    const auto out = scene.Nearest({center + Vector3d(across, 0, 0), Vector3d::UnitZ()});
    ASSERT_TRUE(out && out->sphere_normal);
    EXPECT_NEAR(out->distance, half, 1e-12);
  }
  const auto missed = scene.Nearest({center + Vector3d(0.4001, 0, -1), Vector3d::UnitZ()});
  ASSERT_TRUE(missed);
  EXPECT_FALSE(missed->sphere_normal);
  EXPECT_EQ(missed->triangle, 0);
}

TEST(RayScene, ASpheresHitNamesTheFacetBelow) {
  const Vector3d center(0, 0, 1.5);
  const TriangleMesh mesh = CeilingAndBall(center, 1);
  const RayScene scene(mesh);
  const Vector3d direction = Vector3d(0.1, 0.2, 1).normalized();
  const auto hits = scene.NearestOfPacket(Vector3d(0, 0, -2), std::span(&direction, 1),
                                          std::array<double, 1>{100});
  ASSERT_TRUE(hits[0] && hits[0]->sphere_normal);
  ASSERT_EQ(mesh.SphereOf(hits[0]->triangle), &mesh.spheres[0]);
  EXPECT_EQ(mesh.SphereOf(1), nullptr);
  const Eigen::Vector3i& t = mesh.triangles[hits[0]->triangle];
  const Eigen::Vector2d& uv = hits[0]->uv;
  const Vector3d at =
      ((1 - uv.sum()) * mesh.vertices[t[0]].cast<double>() +
       uv.x() * mesh.vertices[t[1]].cast<double>() + uv.y() * mesh.vertices[t[2]].cast<double>()) -
      center;
  EXPECT_LT((at.normalized() - *hits[0]->sphere_normal).norm(), 1e-6);
  const Eigen::Vector3f up = direction.cast<float>();
  EXPECT_EQ(scene.OcclusionMask(Vector3d(0, 0, -2), std::span(&up, 1), 0), 1);
}

TEST(RayScene, RespectsNearAndFar) {
  const RayScene scene(Ceiling());
  Ray ray{Vector3d::Zero(), Vector3d::UnitZ()};
  EXPECT_TRUE(scene.IsOccluded(ray));
  ray.far = 2.9;
  EXPECT_FALSE(scene.IsOccluded(ray));
  EXPECT_FALSE(scene.Nearest(ray));
  ray.far = 10;
  ray.near = 3.1;
  EXPECT_FALSE(scene.IsOccluded(ray));
  EXPECT_FALSE(scene.Nearest(ray));
}

TEST(RayScene, MissesBesideAndBehind) {
  const RayScene scene(Ceiling());
  EXPECT_FALSE(scene.Nearest({Vector3d(1.01, 0, 0), Vector3d::UnitZ()}));
  EXPECT_FALSE(scene.Nearest({Vector3d::Zero(), -Vector3d::UnitZ()}));
}

TEST(RayScene, AnEmptyMeshIsNeverHit) {
  const RayScene scene(TriangleMesh{});
  EXPECT_FALSE(scene.Nearest({Vector3d::Zero(), Vector3d::UnitZ()}));
  EXPECT_FALSE(scene.IsOccluded({Vector3d::Zero(), Vector3d::UnitZ()}));
  const Eigen::Vector3f up(0, 0, 1);
  EXPECT_EQ(scene.OcclusionMask(Vector3d::Zero(), {&up, 1}, 0), 0);
}

TEST(RayScene, AMaskIsSixteenSingleAnswers) {
  const RayScene scene(RandomTriangles(200, 1));
  std::mt19937 generator(2);
  std::normal_distribution<float> normal;
  int blocked = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3d origin(normal(generator), normal(generator), normal(generator));
    std::vector<Eigen::Vector3f> directions(trial % 17);
    for (auto& direction : directions) {
      direction = Eigen::Vector3f(normal(generator), normal(generator), normal(generator));
      direction.normalize();
    }
    const uint16_t mask = scene.OcclusionMask(origin, directions, 0.5);
    for (size_t i = 0; i < 16; ++i) {
      const bool expected =
          i < directions.size() && scene.IsOccluded({origin, directions[i].cast<double>(), 0.5});
      EXPECT_EQ((mask >> i) & 1, expected) << "trial " << trial << " direction " << i;
      blocked += expected;
    }
  }
  EXPECT_GT(blocked, 500);  // the scene blocks a good part, so the comparison says something
  EXPECT_LT(blocked, 3500);
}

TEST(RayScene, OccludedMeansThatSomethingIsNearest) {
  const RayScene scene(RandomTriangles(200, 3));
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d direction(normal(generator), normal(generator), normal(generator));
    const Ray ray{Vector3d::Zero(), direction.normalized()};
    EXPECT_EQ(scene.IsOccluded(ray), scene.Nearest(ray).has_value());
  }
}

TEST(RayScene, RefusesATriangleOfMissingVertices) {
  EXPECT_THROW(RayScene({{{0, 0, 0}}, {{0, 1, 2}}}), CheckError);
}

TEST(MeshOfPolygons, RaysPassThroughHoles) {
  SceneGeometry scene;
  scene.origin = Vector3d::Zero();
  Polygon wall;
  wall.normal = Vector3d::UnitZ();
  wall.vertices = {{-2, -2, 5}, {2, -2, 5}, {2, 2, 5}, {-2, 2, 5}};
  wall.holes = {{{-1, -1, 5}, {0, -1, 5}, {0, 1, 5}, {-1, 1, 5}}};
  scene.polygons = {wall};
  const RayScene rays(MeshOfPolygons(scene).mesh);
  EXPECT_FALSE(rays.Nearest({Vector3d(-0.5, 0.3, 0), Vector3d::UnitZ()}));
  EXPECT_TRUE(rays.Nearest({Vector3d(0.5, 0.3, 0), Vector3d::UnitZ()}));
  EXPECT_TRUE(rays.Nearest({Vector3d(-0.5, 1.3, 0), Vector3d::UnitZ()}));
  EXPECT_NEAR(AreaOf(wall), 14, 1e-12);
}

TEST(MeshOfPolygons, IsAboutTheOriginAndRemembersItsPolygons) {
  const Vector3d origin(2600000, 1200000, 400);
  SceneGeometry scene;
  scene.origin = origin;
  const auto square = [&](double z) {
    Polygon polygon;
    polygon.normal = Vector3d::UnitZ();
    polygon.vertices = {origin + Vector3d(-1, -1, z), origin + Vector3d(1, -1, z),
                        origin + Vector3d(1, 1, z), origin + Vector3d(-1, 1, z)};
    return polygon;
  };
  scene.polygons = {square(5), square(7.25)};
  const PolygonMesh mesh = MeshOfPolygons(scene);
  EXPECT_EQ(mesh.polygon_of_triangle, (std::vector<int>{0, 0, 1, 1}));
  const RayScene rays(mesh.mesh);
  const auto hit = rays.Nearest({Vector3d(0.3, 0.2, 6), Vector3d::UnitZ()});
  ASSERT_TRUE(hit);
  EXPECT_EQ(mesh.polygon_of_triangle[hit->triangle], 1);
  EXPECT_NEAR(hit->distance, 1.25, 1e-6);
}

}  // namespace
}  // namespace insitu
