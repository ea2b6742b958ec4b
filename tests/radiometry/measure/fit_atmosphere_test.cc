// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/files/error.h"

namespace insitu {
namespace {

const Spectrum kMaterial = Spectrum::LinSpaced(0.1, 0.3);
constexpr double kNoise = 0.002;

Atmosphere Haze() {
  Atmosphere air;
  air.horizon = Spectrum::LinSpaced(0.6, 0.5);
  air.transmittance = Spectrum::LinSpaced(0.9985, 0.9996);
  return air;
}

std::vector<HazeSample> ExactSamples(const Atmosphere& air) {
  std::vector<HazeSample> samples;
  for (const double distance : {15.0, 22.0, 40.0, 75.0, 120.0, 180.0, 250.0, 310.0}) {
    samples.push_back(
        {ApparentColor(kMaterial, air, distance), Spectrum::Constant(kNoise), distance});
  }
  return samples;
}

std::vector<HazeSample> NoisySamples(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, kNoise);
  std::vector<HazeSample> samples = ExactSamples(Haze());
  for (HazeSample& sample : samples) {
    for (double& value : sample.apparent_color) value += noise(random);
  }
  return samples;
}

TEST(FitAtmosphere, Eq7_RecoversExactSamples) {
  const AtmosphereFit fit = FitAtmosphere(ExactSamples(Haze()), Haze().horizon, {});
  EXPECT_LT((fit.air.transmittance - Haze().transmittance).abs().maxCoeff(), 1e-10);
  EXPECT_LT((fit.true_color - kMaterial).abs().maxCoeff(), 1e-9);
  EXPECT_LT(fit.rms, 1e-6);
  EXPECT_TRUE((fit.transmittance_sigma > 0).all());
}

TEST(FitAtmosphere, Eq7_TwoSamplesSuffice) {
  std::vector<HazeSample> samples = ExactSamples(Haze());
  samples = {samples.front(), samples.back()};
  const AtmosphereFit fit = FitAtmosphere(samples, Haze().horizon, {});
  EXPECT_LT((fit.air.transmittance - Haze().transmittance).abs().maxCoeff(), 1e-10);
}

TEST(FitAtmosphere, AsPrintedNeitherSigmasNorBoundsCount) {
  Atmosphere brightening = Haze();
  brightening.transmittance.setConstant(1.0004);
  const AtmosphereFit fit = FitAtmosphere(ExactSamples(brightening), Haze().horizon, {}, true);
  EXPECT_LT((fit.air.transmittance - 1.0004).abs().maxCoeff(), 1e-9);
  std::vector<HazeSample> samples = ExactSamples(Haze());
  samples[3].apparent_color += 0.05;  // which the robust fit leaves out
  const AtmosphereFit alike = FitAtmosphere(samples, Haze().horizon, {}, true);
  samples[3].sigma *= 1000;
  const AtmosphereFit weighed = FitAtmosphere(samples, Haze().horizon, {}, true);
  EXPECT_LT((alike.air.transmittance - weighed.air.transmittance).abs().maxCoeff(), 1e-9);
  EXPECT_GT((alike.air.transmittance - Haze().transmittance).abs().maxCoeff(), 1e-5);
}

TEST(FitAtmosphere, Eq7_ClearAirStaysClear) {
  Atmosphere clear = Haze();
  clear.transmittance.setOnes();
  const AtmosphereFit fit = FitAtmosphere(ExactSamples(clear), clear.horizon, {});
  EXPECT_TRUE((fit.air.transmittance <= 1).all());
  EXPECT_LT((1 - fit.air.transmittance).maxCoeff(), 1e-10);
}

TEST(FitAtmosphere, TransmittanceNeverExceedsOne) {
  Atmosphere impossible = Haze();
  impossible.transmittance.setConstant(1.0005);
  const AtmosphereFit fit = FitAtmosphere(ExactSamples(impossible), Haze().horizon, {});
  EXPECT_TRUE((fit.air.transmittance == 1).all());
}

TEST(FitAtmosphere, ErrorsAgreeWithSigma) {
  double squares = 0;
  const int seeds = 200;
  for (int seed = 0; seed < seeds; ++seed) {
    const AtmosphereFit fit = FitAtmosphere(NoisySamples(seed), Haze().horizon, {});
    squares +=
        ((fit.air.transmittance - Haze().transmittance) / fit.transmittance_sigma).square().mean();
  }
  // sigma is scaled up by the residuals but never down, so it errs a little on the safe side.
  EXPECT_GT(squares / seeds, 0.5);
  EXPECT_LT(squares / seeds, 1.2);
}

TEST(FitAtmosphere, OneContradictingSampleChangesLittle) {
  std::vector<HazeSample> samples = NoisySamples(1);
  samples[5].apparent_color += 100 * kNoise;  // a puddle
  const Eigen::ArrayXd distances = Eigen::ArrayXd::LinSpaced(12, 20, 300);
  for (const double d : distances) {
    samples.push_back({ApparentColor(kMaterial, Haze(), d), Spectrum::Constant(kNoise), d});
  }
  const AtmosphereFit fit = FitAtmosphere(samples, Haze().horizon, {});
  const Spectrum over_200m = fit.air.transmittance.pow(200) - Haze().transmittance.pow(200);
  EXPECT_LT(over_200m.abs().maxCoeff(), 0.01);
}

TEST(FitAtmosphere, AMaterialOfTheHorizonsColorTellsNothing) {
  std::vector<HazeSample> samples = ExactSamples(Haze());
  for (HazeSample& sample : samples) sample.apparent_color = Haze().horizon;
  const AtmosphereFit fit = FitAtmosphere(samples, Haze().horizon, {});
  EXPECT_TRUE((fit.transmittance_sigma == 1).all());
  EXPECT_TRUE((fit.condition > 1e15).all());
}

TEST(FitAtmosphere, LeavesUnusedBinsAlone) {
  const AtmosphereFit fit = FitAtmosphere(ExactSamples(Haze()), Haze().horizon, {9});
  EXPECT_TRUE((fit.transmittance_sigma.tail(kMaxBins - 9) == 0).all());
  EXPECT_TRUE((fit.true_color.tail(kMaxBins - 9) == 0).all());
}

TEST(FitAtmosphere, RefusesOneDistance) {
  std::vector<HazeSample> samples = ExactSamples(Haze());
  for (HazeSample& sample : samples) sample.distance = 50;
  EXPECT_THROW(FitAtmosphere(samples, Haze().horizon, {}), CheckError);
  samples.resize(1);
  EXPECT_THROW(FitAtmosphere(samples, Haze().horizon, {}), CheckError);
}

}  // namespace
}  // namespace insitu
