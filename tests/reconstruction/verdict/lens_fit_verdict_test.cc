// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/lens_fit_verdict.h"

#include <gtest/gtest.h>

#include <random>

namespace insitu {
namespace {

using Eigen::Vector2d;

constexpr int kWidth = 1800, kHeight = 1200, kMarks = 200;

// Test values of good marks, and `bias` of a place on top of them.
template <typename Bias>
Adjustment Adjusted(unsigned seed, const Bias& bias) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  Adjustment adjustment;
  adjustment.sigma0 = 1;
  adjustment.cameras.push_back({});
  adjustment.cameras[0].name = "wide";
  adjustment.poses.push_back({});
  adjustment.poses[0].photo = "P";
  adjustment.poses[0].camera = 0;
  adjustment.scene.cameras.push_back(
      {"P", Camera("LENSMODEL_PINHOLE", {1500, 1500, 899.5, 599.5}, kWidth, kHeight), Rigid3()});
  for (int i = 0; i < kMarks; ++i) {
    const Vector2d pixel(kWidth * uniform(random), kHeight * uniform(random));
    const Vector2d w = bias(pixel) + Vector2d(normal(random), normal(random));
    for (const int axis : {0, 1}) {
      ObservationResidual row{ObservationKind::kImage, axis,        "P",
                              "p" + std::to_string(i), pixel[axis], 0.4 * w[axis]};
      row.sigma = 0.4;
      row.redundancy = 0.9;
      row.w = w[axis];
      adjustment.residuals.push_back(row);
    }
  }
  return adjustment;
}

Vector2d FromMiddle(const Vector2d& pixel) { return pixel - Vector2d(kWidth / 2, kHeight / 2); }

TEST(LensFit, ALensThatBulgesIsFoundByRadius) {
  const Adjustment adjustment = Adjusted(1, [](const Vector2d& pixel) {
    const Vector2d ray = FromMiddle(pixel);
    return Vector2d((ray.norm() > 700 ? 2 : -0.5) * ray.normalized());
  });
  const auto misfits = FindLensMisfits(adjustment);
  ASSERT_EQ(misfits.size(), 1u);
  EXPECT_EQ(misfits[0].by, "radius");
  EXPECT_NEAR(misfits[0].largest_px, 0.8, 0.3);
  EXPECT_GT(misfits[0].statistic, misfits[0].limit);
  std::vector<Finding> findings;
  JudgeLensFit(adjustment, &findings);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_NE(findings[0].reason.find("the lens of camera 'wide' does not fit"), std::string::npos);
  EXPECT_NE(findings[0].remedy.find("--self-calibrate"), std::string::npos);
}

TEST(LensFit, ATiltedLensIsFoundByPlace) {
  const auto misfits = FindLensMisfits(Adjusted(
      1, [](const Vector2d& pixel) { return Vector2d(FromMiddle(pixel).x() > 450 ? 1.5 : 0, 0); }));
  ASSERT_EQ(misfits.size(), 1u);
}

TEST(LensFit, OfLensesThatFitHardlyAnyIsObjectedTo) {
  size_t objections = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    objections +=
        FindLensMisfits(Adjusted(seed, [](const Vector2d&) { return Vector2d(0, 0); })).size();
  }
  EXPECT_LE(objections, 10u);  // 5 %
}

}  // namespace
}  // namespace insitu
