// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/color_temperature.h"

#include <gtest/gtest.h>

#include "radiometry/spectrum/color.h"

namespace insitu {
namespace {

TEST(CorrelatedColorTemperature, OfABlackBodyIsItsTemperature) {
  for (const double kelvin : {1500.0, 2856.0, 5000.0, 6500.0, 12000.0, 40000.0}) {
    const auto found = CorrelatedColorTemperature(3 * BlackBody(kelvin, {}), {});
    ASSERT_TRUE(found) << kelvin;
    EXPECT_NEAR(found->kelvin / kelvin, 1, 1e-3);
    EXPECT_NEAR(found->duv, 0, 1e-4);
  }
}

// [CIE 15] D65: 6504 K, 0.0032 on the green side.
TEST(CorrelatedColorTemperature, OfDaylight) {
  const auto found = CorrelatedColorTemperature(IlluminantD65({}), {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->kelvin, 6504, 60);
  EXPECT_NEAR(found->duv, 0.0032, 0.001);
}

TEST(CorrelatedColorTemperature, NoneOfDarknessOrOfALaser) {
  EXPECT_FALSE(CorrelatedColorTemperature(Spectrum::Zero(), {}));
  Spectrum green = Spectrum::Zero();
  green[6] = 1;
  green[0] = green[12] = 1e-6;
  EXPECT_FALSE(CorrelatedColorTemperature(green, {}));
}

}  // namespace
}  // namespace insitu
