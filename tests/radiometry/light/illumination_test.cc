// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/illumination.h"

#include <gtest/gtest.h>

#include <cmath>
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

// By Snell's law and the amplitudes of both polarisations, another way to the same value.
double FresnelBySnell(double angle, double n) {
  const double inside = std::asin(std::sin(angle) / n);
  const double s = std::sin(angle - inside) / std::sin(angle + inside);
  const double p = std::tan(angle - inside) / std::tan(angle + inside);
  return (s * s + p * p) / 2;
}

TEST(FresnelReflectance, AgreesWithSnellsLaw) {
  for (const double n : {1.33, 1.5, 2.4}) {
    for (double angle = 0.05; angle < 1.55; angle += 0.1) {
      EXPECT_NEAR(FresnelReflectance(std::cos(angle), n), FresnelBySnell(angle, n), 1e-12);
    }
  }
}

TEST(FresnelReflectance, Limits) {
  EXPECT_NEAR(FresnelReflectance(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(FresnelReflectance(0, 1.5), 1, 1e-15);
  for (const double cosine : {0.0, 0.3, 1.0}) EXPECT_NEAR(FresnelReflectance(cosine, 1), 0, 1e-15);
  EXPECT_EQ(FresnelReflectance(0.1, 0.5), 1);  // total reflection
  const double brewster = std::atan(1.5);
  const double s = std::sin(2 * brewster - kPi / 2);
  EXPECT_NEAR(FresnelReflectance(std::cos(brewster), 1.5), s * s / 2, 1e-12);
}

}  // namespace
}  // namespace insitu
