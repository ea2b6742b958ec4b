// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/atmosphere.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"

namespace insitu {
namespace {

Atmosphere Haze() {
  Atmosphere air;
  air.horizon = Spectrum::LinSpaced(0.4, 0.7);
  air.transmittance = Spectrum::LinSpaced(0.998, 0.9999);
  return air;
}

const Spectrum kColor = Spectrum::LinSpaced(0.05, 0.9);

TEST(ApparentColor, Eq2_IsTheTrueColorAtNoDistance) {
  EXPECT_TRUE((ApparentColor(kColor, Haze(), 0) == kColor).all());
}

TEST(ApparentColor, Eq2_TendsToHorizonColor) {
  const Spectrum far = ApparentColor(kColor, Haze(), 1e6);
  EXPECT_LT((far - Haze().horizon).abs().maxCoeff(), 1e-12);
}

TEST(ApparentColor, Eq2_TwoStretchesOfAirActAsTheirSum) {
  const Spectrum first = ApparentColor(kColor, Haze(), 120);
  const Spectrum both = ApparentColor(first, Haze(), 80);
  EXPECT_LT((both - ApparentColor(kColor, Haze(), 200)).abs().maxCoeff(), 1e-14);
}

TEST(ApparentColor, Eq2_HalfwayAtTheHalfValueDistance) {
  Atmosphere air = Haze();
  air.transmittance.setConstant(std::pow(0.5, 1.0 / 300));
  const Spectrum middle = (kColor + air.horizon) / 2;
  EXPECT_LT((ApparentColor(kColor, air, 300) - middle).abs().maxCoeff(), 1e-13);
}

TEST(TrueColor, Eq8_InvertsEq2) {
  for (const double distance : {0.0, 1.0, 57.0, 400.0}) {
    const Spectrum apparent = ApparentColor(kColor, Haze(), distance);
    EXPECT_LT((TrueColor(apparent, Haze(), distance) - kColor).abs().maxCoeff(), 1e-14) << distance;
  }
}

TEST(TrueColor, Eq8_IsNegativeWhereThePhotoIsDarkerThanItsHaze) {
  EXPECT_LT(TrueColor(Spectrum::Zero(), Haze(), 500).maxCoeff(), 0);
}

TEST(TransmittanceOver, RefusesNegativeDistance) {
  EXPECT_THROW(TransmittanceOver(Haze(), -1), CheckError);
}

}  // namespace
}  // namespace insitu
