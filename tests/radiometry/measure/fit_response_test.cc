// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace insitu {
namespace {

using Curve = std::function<double(double)>;  // code of light, both 0 to 1

double Filmic(double light) {  // a toe and a shoulder [Hable 2010]
  const auto h = [](double x) {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.004 / 0.06;
  };
  return SrgbFromLinear(h(4 * light) / h(4));
}

double Kinked(double light) {  // brighter by up to a tenth about a code
  const double code = SrgbFromLinear(light);
  return code + 0.04 * std::exp(-std::pow((code - 0.5) / 0.08, 2)) * (1 - code);
}

double Inverse(const Curve& curve, double code) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) (curve((low + high) / 2) < code ? low : high) = (low + high) / 2;
  return low;
}

// Faces of `surfaces` reflectances, turned all ways, half of them in the shade.
std::vector<ResponseSample> Samples(const std::array<Curve, 3>& curves, double noise) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> error(0, noise);
  const double sun = 2.2 / 6.8e-5, sky = 0.25;
  std::vector<ResponseSample> samples;
  for (int i = 0; i < 400; ++i) {
    ResponseSample sample;
    sample.surface = sample.material = i % 8;
    sample.sun = i % 2 ? share(random) * 6.8e-5 : 0;
    sample.sky = std::numbers::pi * (0.3 + 0.7 * share(random));
    sample.surroundings = Eigen::Vector3d::Constant((std::numbers::pi - sample.sky) * 0.1);
    sample.through.setOnes();
    sample.added.setZero();
    const double rho = sample.surface == 0 ? 0.4 : 0.1 + 0.08 * sample.surface;
    const double light = rho / std::numbers::pi *
                         (sun * sample.sun + sky * sample.sky + sample.surroundings[0]) *
                         std::exp(error(random));
    for (int c = 0; c < 3; ++c) sample.code[c] = curves[c](light);
    if (sample.code.maxCoeff() < 0.98 && sample.code.minCoeff() > 0.03) samples.push_back(sample);
  }
  return samples;
}

TEST(FitResponse, FindsCurvesThatAreNoneOfItsOwn) {
  ResponseFitOptions options;
  options.reflectance.setConstant(0.4);
  options.sigma = 0.003;
  options.sun.setConstant(3 / 6.8e-5);
  options.sky.setConstant(0.3);
  const std::array<Curve, 3> curves = {Filmic, SrgbFromLinear, Kinked};
  const ResponseFit fit = FitResponse(Samples(curves, 0.003), options);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(fit.sun_over_sky[c] * 6.8e-5, 2.2 / 0.25, 0.05 * 2.2 / 0.25) << c;
    for (const auto& [code, light] : fit.curves[c]) {
      if (code < 0.1 || code > 0.9) continue;
      // Of the curve's shape: the samples tell nothing of the last codes, where it is 1.
      const double known = Inverse(curves[c], code) / Inverse(curves[c], 0.5);
      const ResponsePoints& points = fit.curves[c];
      EXPECT_NEAR(light / points[points.size() / 2].second / known, 1, 0.05) << c << " " << code;
    }
  }
  EXPECT_LT(fit.rms, 1.5);
}

TEST(FitResponse, SaysHowWellItKnowsTheLight) {
  ResponseFitOptions options;
  options.reflectance.setConstant(0.4);
  options.sigma = 0.003;
  options.sun.setConstant(3 / 6.8e-5);
  options.sky.setConstant(0.3);
  const std::array<Curve, 3> curves = {SrgbFromLinear, SrgbFromLinear, SrgbFromLinear};
  const ResponseFit fit = FitResponse(Samples(curves, 0.003), options);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(fit.sun_over_sky_sigma[c], 0);
    EXPECT_LT(std::abs(std::log(fit.sun_over_sky[c] * 6.8e-5 * 0.25 / 2.2)),
              4 * fit.sun_over_sky_sigma[c] + 0.01);
  }
}

}  // namespace
}  // namespace insitu
