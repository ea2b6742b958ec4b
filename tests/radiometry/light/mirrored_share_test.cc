// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/mirrored_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace insitu {
namespace {

using Eigen::Vector3d;

// The lobe summed over the hemisphere, which the table knows nothing of.
double LobeOverHemisphere(const Roughness& roughness, double cosine) {
  const Vector3d view(std::sqrt(1 - cosine * cosine), 0, cosine);
  constexpr int kRows = 300, kColumns = 300;
  double sum = 0;
  for (int i = 0; i < kRows; ++i) {
    const double z = (i + 0.5) / kRows, sine = std::sqrt(1 - z * z);
    for (int j = 0; j < kColumns; ++j) {
      const double angle = 2 * std::numbers::pi * (j + 0.5) / kColumns;
      sum += MirrorLobe(roughness, view, {sine * std::cos(angle), sine * std::sin(angle), z});
    }
  }
  return sum * 2 * std::numbers::pi / (kRows * kColumns);
}

TEST(MirroredShare, IsTheLobeOverTheHemisphere) {
  for (const auto distribution : {FacetDistribution::kGgx, FacetDistribution::kBeckmann}) {
    for (const double slope : {0.15, 0.33, 0.7, 1.0}) {
      for (const double cosine : {0.12, 0.45, 0.93}) {
        const Roughness roughness{slope, distribution};
        EXPECT_NEAR(MirroredShare(roughness, cosine), LobeOverHemisphere(roughness, cosine), 0.01)
            << slope << " at " << cosine;
      }
    }
  }
}

TEST(MirroredShare, OfASmoothMirrorIsAll) {
  EXPECT_EQ(MirroredShare({}, 0.3), 1);
  EXPECT_NEAR(MirroredShare({0.01}, 0.5), 1, 0.01);
  EXPECT_LT(MirroredShare({1}, 1), 0.7);  // a third is lost at GGX of alpha 1
}

}  // namespace
}  // namespace insitu
