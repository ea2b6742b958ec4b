// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/ray_cast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

Face FaceOf(const std::vector<Vector3d>& vertices) {
  Face face;
  face.vertices = vertices;
  return FinishFace(face);
}

// An L in the plane z = 2: the square [0, 2]^2 without [1, 2]^2.
Face LShape() { return FaceOf({{0, 0, 2}, {2, 0, 2}, {2, 1, 2}, {1, 1, 2}, {1, 2, 2}, {0, 2, 2}}); }

std::vector<Face> RandomTriangles(int count) {
  Random random(21, 0, 0);
  const auto point = [&random] {
    return Vector3d(random.Uniform(), random.Uniform(), random.Uniform());
  };
  std::vector<Face> faces;
  for (int i = 0; i < count; ++i) {
    const Vector3d corner = point();
    faces.push_back(FaceOf({corner, corner + 0.3 * point(), corner - 0.3 * point()}));
  }
  return faces;
}

TEST(FinishFace, TurnsTheNormalOutOfACounterClockwiseOutline) {
  const Face face = LShape();
  EXPECT_LT((face.normal - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((face.Local({1.5, 0.25, 2}) - Eigen::Vector2d(1.5, 0.25)).norm(), 1e-15);
}

TEST(Intersect, RespectsAConcaveOutline) {
  const Face face = LShape();
  const Vector3d up = Vector3d::UnitZ();
  EXPECT_NEAR(*Intersect(face, {{0.5, 1.5, 0}, up}), 2, 1e-15);
  EXPECT_NEAR(*Intersect(face, {{1.5, 0.5, 0}, up}), 2, 1e-15);
  EXPECT_FALSE(Intersect(face, {{1.5, 1.5, 0}, up}));  // in the notch
  EXPECT_FALSE(Intersect(face, {{2.5, 0.5, 0}, up}));
  EXPECT_FALSE(Intersect(face, {{-0.1, 0.5, 0}, up}));
}

TEST(Intersect, SeesBothSidesButNotBehindTheOrigin) {
  const Face face = LShape();
  EXPECT_NEAR(*Intersect(face, {{0.5, 0.5, 5}, -Vector3d::UnitZ()}), 3, 1e-15);
  EXPECT_FALSE(Intersect(face, {{0.5, 0.5, 5}, Vector3d::UnitZ()}));
  EXPECT_FALSE(Intersect(face, {{0.5, 0.5, 2.1}, Vector3d::UnitZ()}));  // close behind
  EXPECT_FALSE(Intersect(face, {{0.5, 0.5, 1}, Vector3d::UnitX()}));    // parallel
}

TEST(NearestHit, TakesTheNearerOfTwoWithinTheLimit) {
  const Scene scene = MakeScene({LShape(), FaceOf({{0, 0, 3}, {2, 0, 3}, {2, 2, 3}, {0, 2, 3}})});
  const Ray ray{{0.5, 0.5, 0}, Vector3d::UnitZ()};
  EXPECT_NEAR(NearestHit(scene, ray)->distance, 2, 1e-15);
  EXPECT_FALSE(NearestHit(scene, ray, 1.9));
  EXPECT_NEAR(NearestHit(scene, {{1.5, 1.5, 0}, Vector3d::UnitZ()})->distance, 3, 1e-15);
  EXPECT_TRUE(IsBlocked(scene, ray, 2.1));
  EXPECT_FALSE(IsBlocked(scene, ray, 1.9));
  EXPECT_FALSE(NearestHit(MakeScene({}), ray));
}

TEST(NearestHit, AgreesWithTryingEveryFace) {
  const std::vector<Face> faces = RandomTriangles(300);
  const Scene scene = MakeScene(faces);
  Random random(22, 0, 0);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{{random.Uniform(), random.Uniform(), random.Uniform()},
                  Vector3d(random.Gaussian(), random.Gaussian(), random.Gaussian()).normalized()};
    double nearest = 1e9;
    for (const Face& face : faces) nearest = std::min(nearest, Intersect(face, ray).value_or(1e9));
    const auto hit = NearestHit(scene, ray);
    ASSERT_EQ(hit.has_value(), nearest < 1e9);
    ASSERT_EQ(IsBlocked(scene, ray), hit.has_value());
    if (!hit) continue;
    EXPECT_EQ(hit->distance, nearest);
    ++hits;
  }
  EXPECT_GT(hits, 500);
  EXPECT_LT(hits, 2000);
}

}  // namespace
}  // namespace insitu::demo
