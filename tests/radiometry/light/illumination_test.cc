// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/illumination.h"

#include <gtest/gtest.h>

#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(ReflectedRadiance, Eq6_WhiteSurfaceInAFurnaceDisappears) {
  const Spectrum furnace = Spectrum::LinSpaced(1, 2);  // radiance from everywhere
  const Spectrum brdf = Spectrum::Constant(1 / kPi);   // albedo 1
  EXPECT_LT((ReflectedRadiance(1, brdf, furnace * kPi) - furnace).abs().maxCoeff(), 1e-15);
}

TEST(ReflectedRadiance, Eq6_NegativeIrradianceTakesLightAway) {
  const Spectrum brdf = Spectrum::Constant(0.1);
  EXPECT_NEAR(ReflectedRadiance(0.5, brdf, Spectrum::Constant(-2)).maxCoeff(), -0.1, 1e-16);
}

TEST(DiffuseBrdf, Eq10_InvertsEq6) {
  const Spectrum brdf = Spectrum::LinSpaced(0.01, 0.3), irradiance = Spectrum::LinSpaced(5, 0.2);
  const Spectrum radiance = ReflectedRadiance(0.7, brdf, irradiance);
  EXPECT_LT((DiffuseBrdf(radiance, 0.7, irradiance) - brdf).abs().maxCoeff(), 1e-16);
}

TEST(DiffuseBrdf, Eq10_IsZeroWithoutLight) {
  EXPECT_TRUE((DiffuseBrdf(Spectrum::Ones(), 1, Spectrum::Zero()) == 0).all());
  EXPECT_THROW(DiffuseBrdf(Spectrum::Ones(), 0, Spectrum::Ones()), CheckError);
}

}  // namespace
}  // namespace insitu
