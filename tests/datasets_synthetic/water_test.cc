// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/water.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(Waves, HaveTheirSlopesAndNoTiltOfTheirOwn) {
  const Waves waves{0.08, 2.0, 0.25, 3};
  constexpr int kAcross = 200;
  Vector2d mean = Vector2d::Zero();
  double square = 0;
  for (int i = 0; i < kAcross * kAcross; ++i) {
    const int column = i % kAcross, row = i / kAcross;
    const Vector2d at(0.317 * column, 0.293 * row);
    const Vector2d slope = WaveSlope(waves, at);
    mean += slope / (kAcross * kAcross);
    square += slope.squaredNorm() / (kAcross * kAcross);
  }
  EXPECT_NEAR(std::sqrt(square), waves.rms_slope, 0.03 * waves.rms_slope);
  EXPECT_LT(mean.norm(), 0.05 * waves.rms_slope);
}

TEST(Waves, AreTheSamePlaceByPlaceAndOtherWithAnotherSeed) {
  const Waves waves{0.08, 2.0, 0.25, 3}, other{0.08, 2.0, 0.25, 40};
  EXPECT_EQ(WaveSlope(waves, {1.7, -3.1}), WaveSlope(waves, {1.7, -3.1}));
  EXPECT_NE(WaveSlope(waves, {1.7, -3.1}), WaveSlope(other, {1.7, -3.1}));
}

TEST(Waves, TiltTheNormalTowardsTheViewer) {
  Face face;
  face.vertices = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
  face = FinishFace(face);
  EXPECT_EQ(WaveNormal({}, face, {2, 3, 0}, {0, 0, 1}), Vector3d::UnitZ());
  const Waves waves{0.3, 2.0, 1.0, 3};
  const Vector3d above = WaveNormal(waves, face, {2, 3, 0}, {0, 0, 1});
  const Vector2d slope = WaveSlope(waves, {2, 3});
  EXPECT_LT((above - Vector3d(-slope.x(), -slope.y(), 1).normalized()).norm(), 1e-12);
  EXPECT_LT((WaveNormal(waves, face, {2, 3, 0}, {0, 0, -1}) + above).norm(), 1e-12);
}

}  // namespace
}  // namespace insitu::demo
