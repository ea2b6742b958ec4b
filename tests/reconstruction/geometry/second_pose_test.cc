// SPDX-License-Identifier: GPL-3.0-or-later
// A photo of few points in one plane often fits them from two places: both must be found, and the
// second told.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "reconstruction/geometry/resection.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr int kNetworks = 200;

Rigid3 LookingAt(const Vector3d& center, const Vector3d& target) {
  Eigen::Matrix3d rotation;
  rotation.row(2) = (target - center).normalized();
  rotation.row(0) = rotation.row(2).transpose().cross(Vector3d::UnitZ()).normalized();
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  const Eigen::Quaterniond q(rotation);
  return {q, -(q * center)};
}

struct DrawnPhoto {
  Camera camera;
  Rigid3 truth;
  std::vector<ResectionPoint> points;
};

class SecondPoses : public testing::Test {
 protected:
  double Uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  double Normal() { return std::normal_distribution<double>()(random_); }

  // Points on a facade of `width`, off its plane by up to `depth`, seen from `distance`.
  DrawnPhoto Draw(int count, double width, double depth, double distance, double focal_px) {
    const Camera camera("LENSMODEL_PINHOLE", {focal_px, focal_px, 1999.5, 1499.5}, 4000, 3000);
    const double azimuth = Uniform(-1, 1);
    const Vector3d target(width / 2, 0, width / 4);
    const Vector3d center =
        target + distance * Vector3d(std::sin(azimuth), -std::cos(azimuth), Uniform(-0.05, 0.1));
    DrawnPhoto drawn{camera, LookingAt(center, target), {}};
    while (drawn.points.size() < static_cast<size_t>(count)) {
      const Vector3d world(Uniform(0, width), Uniform(-depth, 0), Uniform(0, width / 2));
      const auto pixel = camera.Project(drawn.truth * world);
      if (!pixel || !camera.Sees(*pixel)) continue;
      drawn.points.push_back({world, *pixel + 0.5 * Eigen::Vector2d(Normal(), Normal()), 0.5, 0});
    }
    return drawn;
  }

  static bool IsWrong(const DrawnPhoto& drawn, const Resections& found) {
    const Vector3d off = Center(found.best.cam_from_world) - Center(drawn.truth);
    const Eigen::Matrix3d covariance = found.best.covariance.bottomRightCorner<3, 3>();
    return off.dot(covariance.ldlt().solve(off)) > 40;  // chi squared of three, 1e-8
  }

  std::mt19937 random_{11};
};

TEST_F(SecondPoses, OfWeakPlanesNoWrongPoseGoesWithoutAWarning) {
  int wrong = 0, silent = 0, warned = 0, lost = 0;
  for (int i = 0; i < kNetworks; ++i) {
    const double width = Uniform(4, 10), distance = width * Uniform(20, 60);
    const DrawnPhoto drawn =
        Draw(4 + i % 5, width, 0, distance, Uniform(1500, 2500) * distance / width / 4);
    const auto found = ResectAll(drawn.camera, drawn.points);
    if (!found) {
      ++lost;
      continue;
    }
    wrong += IsWrong(drawn, *found);
    silent += IsWrong(drawn, *found) && found->seconds.empty();
    warned += !found->seconds.empty();
  }
  RecordProperty("wrong", wrong);
  RecordProperty("warned", warned);
  EXPECT_EQ(lost, 0);
  EXPECT_GT(wrong, 10);  // the draw is weak indeed
  EXPECT_EQ(silent, 0) << "of " << wrong << " wrong poses, " << warned << " warnings";
}

TEST_F(SecondPoses, OfWellDeterminedPhotosHardlyAnyIsWarnedOf) {
  int warned = 0, wrong = 0;
  for (int i = 0; i < kNetworks; ++i) {
    const double width = Uniform(6, 12), distance = width * Uniform(1.2, 2.5);
    const double depth = i % 2 == 0 ? width / 2 : 0;
    const DrawnPhoto drawn = Draw(6 + i % 10, width, depth, distance, 3500);
    const auto found = ResectAll(drawn.camera, drawn.points);
    ASSERT_TRUE(found);
    wrong += IsWrong(drawn, *found);
    warned += !found->seconds.empty();
  }
  RecordProperty("warned", warned);
  EXPECT_LE(warned, kNetworks / 20);
  EXPECT_EQ(wrong, 0);
}

TEST_F(SecondPoses, AnEstimateOrASurveyedPlaceDecides) {
  int decided = 0;
  for (int i = 0; i < 20; ++i) {
    const DrawnPhoto drawn = Draw(6, 6, 0, 300, 20000);
    const auto plain = ResectAll(drawn.camera, drawn.points);
    ASSERT_TRUE(plain);
    if (plain->seconds.empty()) continue;
    EXPECT_TRUE(plain->are_coplanar);
    EXPECT_TRUE(plain->deciding_m);
    const auto off = [&](const Rigid3& pose) {
      return (Center(pose) - Center(drawn.truth)).norm();
    };
    double nearest = off(plain->best.cam_from_world);
    for (const SecondPose& second : plain->seconds) {
      decided += off(second.cam_from_world) < nearest;
      nearest = std::min(nearest, off(second.cam_from_world));
    }
    const auto estimated = ResectAll(drawn.camera, drawn.points, drawn.truth);
    EXPECT_LE(off(estimated->best.cam_from_world), nearest + 0.1);
    EXPECT_TRUE(estimated->seconds.empty());
    const auto placed =
        ResectAll(drawn.camera, drawn.points, std::nullopt, SurveyedCenter{Center(drawn.truth), 1});
    EXPECT_LE(off(placed->best.cam_from_world), nearest + 0.1);
    const auto vague = ResectAll(drawn.camera, drawn.points, std::nullopt,
                                 SurveyedCenter{Center(drawn.truth), 1000});
    EXPECT_FALSE(vague->seconds.empty());
  }
  EXPECT_GT(decided, 2);  // the marks alone were mistaken
}

}  // namespace
}  // namespace insitu
