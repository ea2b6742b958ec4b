// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_daylight.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "calibration/files/error.h"
#include "radiometry/spectrum/color.h"
#include "radiometry/spectrum/rgb_to_spectrum.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNoise = 0.003;
const Spectrum kBrdf = Spectrum::LinSpaced(0.1, 0.15);

Daylight Truth() {
  Daylight light;
  light.sun_radiance = Spectrum::LinSpaced(6e4, 8e4);
  light.ambient_radiance = Spectrum::LinSpaced(0.05, 0.12);
  light.sky_radiance = Spectrum::LinSpaced(0.8, 0.4);
  return light;
}

std::vector<LightGeometry> VariedLight() {
  std::vector<LightGeometry> seen;
  for (const double sun : {0.0, 0.2, 0.5, 0.9}) {
    for (const double sky : {0.3, 1.2, 2.0, kPi}) {
      seen.push_back({sun * kSolarSolidAngle, kPi, sky});
    }
  }
  return seen;
}

std::vector<DaylightSample> ExactSamples(const Daylight& light) {
  std::vector<DaylightSample> samples;
  for (const LightGeometry& seen : VariedLight()) {
    samples.push_back({kBrdf * TotalIrradiance(light, seen), Spectrum::Constant(kNoise), seen});
  }
  return samples;
}

double RelativeError(const Spectrum& value, const Spectrum& truth) {
  return (value / truth - 1).abs().maxCoeff();
}

TEST(FitDaylight, Eq9_RecoversExactSamplesPerWavelength) {
  const DaylightFit fit = FitDaylight(ExactSamples(Truth()), kBrdf, true, {});
  EXPECT_LT(RelativeError(fit.sun_radiance, Truth().sun_radiance), 1e-11);
  EXPECT_LT(RelativeError(fit.ambient_radiance, Truth().ambient_radiance), 1e-10);
  EXPECT_LT(RelativeError(fit.sky_radiance, Truth().sky_radiance), 1e-10);
  EXPECT_LT(fit.rms, 1e-9);
  EXPECT_GT(fit.condition, 1);
  EXPECT_LT(fit.condition, 20);
}

TEST(FitDaylight, Eq9_ThreeSamplesSuffice) {
  const std::vector<DaylightSample> all = ExactSamples(Truth());
  const DaylightFit fit = FitDaylight({all[0], all[3], all[13]}, kBrdf, true, {});
  EXPECT_LT(RelativeError(fit.sun_radiance, Truth().sun_radiance), 1e-10);
}

TEST(FitDaylight, WeightsAreNeverNegative) {
  Daylight impossible = Truth();
  impossible.ambient_radiance.setConstant(-0.05);
  const DaylightFit fit = FitDaylight(ExactSamples(impossible), kBrdf, true, {});
  EXPECT_TRUE((fit.ambient_radiance == 0).all());
  EXPECT_TRUE((fit.sky_radiance > 0).all());
  EXPECT_TRUE((fit.sun_radiance > 0).all());
  EXPECT_TRUE((fit.ambient_sigma > 0).all());
}

DaylightFitOptions AsPrinted() {
  DaylightFitOptions options;
  options.as_printed = true;
  return options;
}

// [Durisch92, §4.3]: k(lambda) of each bin, then the plain mean, times D65.
TEST(FitDaylight, AsPrintedAveragesTheWeightsOverTheSpectrum) {
  const SpectralBins bins{9};
  const Spectrum used = SpectralBasis(Rec709(), bins).Ones();
  const DaylightFit fit = FitDaylight(ExactSamples(Truth()), kBrdf, true, bins, AsPrinted());
  const Spectrum D65 = IlluminantD65(bins);
  const auto expected = [&](const Spectrum& radiance) -> Spectrum {
    double k = 0;
    for (int bin = 0; bin < 9; ++bin) k += radiance[bin] / D65[bin] / 9;
    return used * k * D65;
  };
  EXPECT_LT((fit.sun_radiance - expected(Truth().sun_radiance)).abs().maxCoeff(), 1e-5);
  EXPECT_LT((fit.ambient_radiance - expected(Truth().ambient_radiance)).abs().maxCoeff(), 1e-10);
  EXPECT_LT((fit.sky_radiance - expected(Truth().sky_radiance)).abs().maxCoeff(), 1e-10);
}

TEST(FitDaylight, AsPrintedNoSampleWeighsMoreAndNoWeightIsHeldAtZero) {
  Daylight impossible = Truth();
  impossible.ambient_radiance.setConstant(-0.05);
  EXPECT_LT(FitDaylight(ExactSamples(impossible), kBrdf, true, {}, AsPrinted())
                .ambient_radiance.maxCoeff(),
            0);
  std::vector<DaylightSample> samples = ExactSamples(Truth());
  samples[5].true_color *= 1.5;  // which the robust fit leaves out
  const DaylightFit alike = FitDaylight(samples, kBrdf, true, {}, AsPrinted());
  samples[5].sigma *= 1000;
  const DaylightFit weighed = FitDaylight(samples, kBrdf, true, {}, AsPrinted());
  EXPECT_LT(RelativeError(weighed.sky_radiance, alike.sky_radiance), 1e-9);
  EXPECT_GT(
      RelativeError(alike.sky_radiance,
                    FitDaylight(ExactSamples(Truth()), kBrdf, true, {}, AsPrinted()).sky_radiance),
      0.01);
}

TEST(FitDaylight, OvercastHasNoSun) {
  Daylight overcast = Truth();
  overcast.sun_radiance.setZero();
  const DaylightFit fit = FitDaylight(ExactSamples(overcast), kBrdf, false, {});
  EXPECT_TRUE((fit.sun_radiance == 0).all());
  EXPECT_LT(RelativeError(fit.sky_radiance, Truth().sky_radiance), 1e-10);
}

TEST(FitDaylight, ASunThatNoSampleSeesStaysDark) {
  std::vector<DaylightSample> samples = ExactSamples(Truth());
  samples.resize(4);  // those in shadow
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_TRUE((fit.sun_radiance == 0).all());
  EXPECT_TRUE((fit.sun_sigma == 0).all());
  EXPECT_LT(RelativeError(fit.ambient_radiance, Truth().ambient_radiance), 1e-9);
}

TEST(FitDaylight, SamplesThatSeeOneSkyLeaveItOpenButStillFit) {
  std::vector<DaylightSample> samples = ExactSamples(Truth());
  std::erase_if(samples, [](const DaylightSample& s) { return s.geometry.sky != 2.0; });
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_GT(fit.condition, 1e6);
  EXPECT_LT(fit.rms, 1e-6);
  EXPECT_LT(RelativeError(fit.sun_radiance, Truth().sun_radiance), 1e-9);
}

TEST(FitDaylight, ErrorsAgreeWithSigma) {
  double sun = 0, sky = 0;
  const int seeds = 200;
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, kNoise);
    std::vector<DaylightSample> samples = ExactSamples(Truth());
    for (DaylightSample& sample : samples) {
      for (double& value : sample.true_color) value += noise(random);
    }
    const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
    sun += ((fit.sun_radiance - Truth().sun_radiance) / fit.sun_sigma).square().mean();
    sky += ((fit.sky_radiance - Truth().sky_radiance) / fit.sky_sigma).square().mean();
  }
  EXPECT_GT(sun / seeds, 0.6);
  EXPECT_LT(sun / seeds, 1.2);
  EXPECT_GT(sky / seeds, 0.6);
  EXPECT_LT(sky / seeds, 1.2);
}

TEST(FitDaylight, OneContradictingSampleChangesLittle) {
  std::vector<DaylightSample> samples = ExactSamples(Truth());
  samples[13].true_color *= 0.5;  // in the shadow of a tree that nobody surveyed
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_LT(RelativeError(fit.sun_radiance, Truth().sun_radiance), 0.03);
  EXPECT_GT(fit.residuals[13], -1.5);
  EXPECT_LT(fit.residuals[13], -0.8);  // it shows less than half of what the model says
}

TEST(FitDaylight, AveragingGivesAllComponentsTheSpectrumOfD65) {
  const SpectralBins bins;
  Daylight truth = Truth();
  const Spectrum d65 = IlluminantD65(bins);
  truth.sun_radiance = 7e4 * d65;
  const DaylightFit fit = FitDaylight(ExactSamples(truth), kBrdf, true, bins, {true});
  EXPECT_LT(RelativeError(fit.sun_radiance, truth.sun_radiance), 1e-10);
  const Spectrum k_h = fit.sky_radiance / d65;
  EXPECT_LT(k_h.maxCoeff() - k_h.minCoeff(), 1e-12);
  EXPECT_NEAR(Tristimulus(fit.sky_radiance, bins).y(), Tristimulus(truth.sky_radiance, bins).y(),
              1e-12);
}

// Samples whose surroundings differ, as those of sunlit walls and shaded ones do.
std::vector<DaylightSample> SamplesWithSurroundings() {
  std::vector<DaylightSample> samples = ExactSamples(Truth());
  for (size_t i = 0; i < samples.size(); ++i) {
    const LightGeometry& seen = samples[i].geometry;
    const Spectrum around =
        Spectrum::Constant((kPi - seen.sky) * (0.1 + 2000 * seen.sun + 0.02 * (i % 3)));
    samples[i].true_color =
        kBrdf * (Truth().sun_radiance * seen.sun + Truth().sky_radiance * seen.sky + around);
    samples[i].surroundings = around;
  }
  return samples;
}

TEST(FitDaylight, KnownSurroundingsLeaveSunAndSkyAsTheyAre) {
  const std::vector<DaylightSample> samples = SamplesWithSurroundings();
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_LT(RelativeError(fit.sun_radiance, Truth().sun_radiance), 1e-10);
  EXPECT_LT(RelativeError(fit.sky_radiance + fit.ambient_radiance, Truth().sky_radiance), 1e-10);
  EXPECT_LT(fit.rms, 1e-9);
  double irradiance = 0, hidden = 0;
  for (const DaylightSample& sample : samples) {
    irradiance += (*sample.surroundings)[0];
    hidden += kPi - sample.geometry.sky;
  }
  EXPECT_NEAR(fit.ambient_radiance[0], irradiance / hidden, 1e-10);
}

// A sample that sees a bright part of the sky does not make all of it brighter.
TEST(FitDaylight, TheSkyCountsAsItIsSpread) {
  std::vector<DaylightSample> samples = SamplesWithSurroundings();
  for (size_t i = 0; i < samples.size(); ++i) {
    DaylightSample& sample = samples[i];
    sample.relative_sky = Spectrum::LinSpaced(0.7, 1.1) + 0.1 * (i % 4);
    sample.true_color +=
        kBrdf * Truth().sky_radiance * sample.geometry.sky * (sample.relative_sky - 1);
  }
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_LT(RelativeError(fit.sun_radiance, Truth().sun_radiance), 1e-10);
  EXPECT_LT(RelativeError(fit.sky_radiance + fit.ambient_radiance, Truth().sky_radiance), 1e-10);
  EXPECT_LT(fit.rms, 1e-9);
}

// No weight of theirs is left to fit: what they are taken for too little, sun and sky must bear.
TEST(FitDaylight, SurroundingsAreNoUnknown) {
  std::vector<DaylightSample> samples = SamplesWithSurroundings();
  for (DaylightSample& sample : samples) *sample.surroundings *= 0.5;
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_GT((fit.sun_radiance / Truth().sun_radiance).minCoeff(), 1.01);
  EXPECT_GT(fit.rms, 1);
  EXPECT_TRUE((fit.ambient_sigma == 0).all());
}

TEST(FitDaylight, ThreeSamplesInKnownSurroundingsSuffice) {
  std::vector<DaylightSample> samples = SamplesWithSurroundings();
  samples = {samples[0], samples[3], samples[13]};
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_LT(RelativeError(fit.sun_radiance, Truth().sun_radiance), 1e-10);
  EXPECT_LT(fit.condition, 20);
}

TEST(FitDaylight, UniformAmbientLightLetsTheSunTakeAShareOfTheSurroundings) {
  std::vector<DaylightSample> samples = SamplesWithSurroundings();
  for (DaylightSample& sample : samples) sample.surroundings.reset();
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  EXPECT_GT((fit.sun_radiance / Truth().sun_radiance).minCoeff(), 1.01);
}

TEST(FitDaylight, RefusesSurroundingsOfSomeSamplesOnly) {
  std::vector<DaylightSample> samples = SamplesWithSurroundings();
  samples[3].surroundings.reset();
  EXPECT_THROW(FitDaylight(samples, kBrdf, true, {}), CheckError);
}

TEST(FitDaylight, RefusesTooFewSamples) {
  std::vector<DaylightSample> samples = ExactSamples(Truth());
  samples.resize(2);
  EXPECT_THROW(FitDaylight(samples, kBrdf, true, {}), CheckError);
  EXPECT_NO_THROW(FitDaylight(samples, kBrdf, false, {}));
}

// Samples under a sky of which they see little, on an uneven material.
class FitDaylightUnderASky : public testing::Test {
 protected:
  FitDaylightUnderASky() {
    light_.ambient_radiance.setZero();
    MakeSamples(0.1);
  }
  // `unevenness`: standard deviation of their reflectance, relative.
  void MakeSamples(double unevenness) {
    std::mt19937 random(5);
    std::normal_distribution<double> texture(1, unevenness);
    samples_ = ExactSamples(light_);
    for (DaylightSample& sample : samples_) {
      sample.geometry.sky *= 0.2;
      sample.surroundings = Spectrum::Constant(0.5);
      sample.true_color = texture(random) * kBrdf *
                          (light_.sun_radiance * sample.geometry.sun +
                           light_.sky_radiance * sample.geometry.sky + *sample.surroundings);
      sample.sigma = 0.003 * sample.true_color;  // of the mean over a few pixels
    }
  }
  DaylightFit Fit(const std::optional<SkyObservation>& sky) const {
    return FitDaylight(samples_, kBrdf, true, {}, {.sky = sky});
  }
  // Of the open sky.
  double SkyError(const DaylightFit& fit) const {
    return RelativeError(fit.sky_radiance + fit.ambient_radiance, light_.sky_radiance);
  }

  Daylight light_ = Truth();
  std::vector<DaylightSample> samples_;
};

TEST_F(FitDaylightUnderASky, ThePhotographedSkyIsAnObservation) {
  const SkyObservation sky = {light_.sky_radiance, 0.05 * light_.sky_radiance};
  const DaylightFit without = Fit(std::nullopt), with = Fit(sky);
  EXPECT_FALSE(without.sky_over_sigma);
  EXPECT_GT(SkyError(without), 0.08);
  EXPECT_LT(SkyError(with), 0.05);
  EXPECT_TRUE((with.sky_sigma < 0.8 * without.sky_sigma).all());
  ASSERT_TRUE(with.sky_over_sigma);
  EXPECT_LT(*with.sky_over_sigma, 1);
}

TEST_F(FitDaylightUnderASky, AVagueSkyChangesNothing) {
  const DaylightFit without = Fit(std::nullopt),
                    with = Fit(SkyObservation{2 * light_.sky_radiance, 50 * light_.sky_radiance});
  EXPECT_LT(RelativeError(with.sun_radiance, without.sun_radiance), 1e-3);
  EXPECT_LT(RelativeError(with.sky_radiance, without.sky_radiance), 1e-3);
}

TEST_F(FitDaylightUnderASky, ASkyThatContradictsTheSamplesCountsLess) {
  MakeSamples(
      0.03);  // which tell the sky to 9 %; believed, the other would make it twice as bright
  const SkyObservation other = {6 * light_.sky_radiance, 0.15 * light_.sky_radiance};
  EXPECT_LT(SkyError(Fit(other)), 0.5);
  EXPECT_GT(*Fit(other).sky_over_sigma, 10);
}

}  // namespace
}  // namespace insitu
