// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;

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

// By the complex amplitudes, another way to the same value.
double MetalByAmplitudes(double cosine, std::complex<double> n) {
  const std::complex<double> inside = std::sqrt(1.0 - (1 - cosine * cosine) / (n * n));
  const std::complex<double> s = (cosine - n * inside) / (cosine + n * inside);
  const std::complex<double> p = (n * cosine - inside) / (n * cosine + inside);
  return (std::norm(s) + std::norm(p)) / 2;
}

TEST(ConductorReflectance, AgreesWithComplexAmplitudes) {
  for (const std::complex<double> n :
       {std::complex(0.2, 3.9), {1.3, 7.5}, {2.9, 3.1}, {1.5, 0.0}}) {
    for (const double cosine : {0.02, 0.3, 0.7, 1.0}) {
      const Spectrum F =
          ConductorReflectance(cosine, Spectrum::Constant(n.real()), Spectrum::Constant(n.imag()));
      EXPECT_NEAR(F[0], MetalByAmplitudes(cosine, n), 1e-12) << n << " at " << cosine;
    }
  }
}

TEST(RefractedCosine, FollowsSnell) {
  EXPECT_NEAR(RefractedCosine(std::cos(0.7), 1.5), std::cos(std::asin(std::sin(0.7) / 1.5)), 1e-15);
  EXPECT_EQ(RefractedCosine(std::cos(0.8), 1 / 1.5), 0);  // beyond the limit of 0.7297
}

TEST(ThinSheet, IsTheSumOfItsReflections) {
  const Spectrum k = Spectrum::LinSpaced(0, 30);
  const double d = 0.01, n = 1.52, cosine = 0.4;
  const double F = FresnelReflectance(cosine, n);
  const Spectrum a = (-k * d / RefractedCosine(cosine, n)).exp();
  Spectrum through = Spectrum::Zero(), back = Spectrum::Constant(F), inside = (1 - F) * a;
  for (int i = 0; i < 60; ++i) {  // from face to face
    ((i % 2 == 0) ? through : back) += (1 - F) * inside;
    inside *= F * a;
  }
  const SheetOptics sheet = ThinSheet(cosine, n, k, d);
  EXPECT_LT((sheet.transmittance - through).abs().maxCoeff(), 1e-14);
  EXPECT_LT((sheet.reflectance - back).abs().maxCoeff(), 1e-14);
}

TEST(ThinSheet, KeepsAllLightThatItDoesNotAbsorb) {
  for (const double cosine : {1e-3, 0.2, 1.0}) {
    const SheetOptics sheet = ThinSheet(cosine, 1.52, Spectrum::Zero(), 0.01);
    EXPECT_LT((sheet.transmittance + sheet.reflectance - 1).abs().maxCoeff(), 1e-14);
  }
  EXPECT_EQ(ThinSheet(0, 1.5, Spectrum::Zero(), 0.01).reflectance[0], 1);
  EXPECT_THROW(ThinSheet(1, 0.9, Spectrum::Zero(), 0.01), CheckError);
}

}  // namespace
}  // namespace insitu
