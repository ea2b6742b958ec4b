// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/spectral_table.h"

#include <gtest/gtest.h>

#include "radiometry/spectrum/color.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

TEST(SpectralTable, KnownChromaticities) {
  const auto xy = [](const SpectralTable& table) {
    return Eigen::Vector2d(Chromaticity(Tristimulus(Sampled(table, {}), {})).head<2>());
  };
  EXPECT_NEAR((xy(IlluminantATable()) - Eigen::Vector2d(0.44758, 0.40745)).norm(), 0, 1e-3);
  EXPECT_NEAR((xy(D65Table()) - Eigen::Vector2d(0.31271, 0.32902)).norm(), 0, 2e-3);
  EXPECT_NEAR((xy(BlackbodyTable(6500)) - Eigen::Vector2d(0.3135, 0.3237)).norm(), 0, 1e-3);
  EXPECT_NEAR((ColorOfReflectance({{380, 0.4}, {780, 0.4}}) - Vector3d::Constant(0.4)).norm(), 0,
              2e-3);
  EXPECT_NEAR(Sampled({{380, 0}, {780, 400}}, {})[0], 12.5, 1e-9);  // the middle of 25 nm
}

// CIELAB of the sRGB primaries, from Lindbloom's calculator: D65 as is, D50 adapted by Bradford.
TEST(LinearFromLab, OfPublishedColors) {
  EXPECT_NEAR((LinearFromLab({100, 0, 0}, false) - Vector3d(1, 1, 1)).norm(), 0, 2e-3);
  EXPECT_NEAR((LinearFromLab({100, 0, 0}, true) - Vector3d(1, 1, 1)).norm(), 0, 2e-3);
  EXPECT_NEAR((LinearFromLab({53.2408, 80.0925, 67.2032}, false) - Vector3d(1, 0, 0)).norm(), 0,
              3e-3);
  EXPECT_NEAR((LinearFromLab({54.2917, 80.8125, 69.8851}, true) - Vector3d(1, 0, 0)).norm(), 0,
              3e-3);
}

}  // namespace
}  // namespace insitu
