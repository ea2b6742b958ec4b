// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/further_sample.h"

#include <gtest/gtest.h>

#include <numbers>

namespace insitu {
namespace {

const Spectrum kBrdf = Spectrum::Constant(0.1);

std::vector<DaylightSample> SamplesAt(const std::vector<LightGeometry>& seen) {
  std::vector<DaylightSample> samples;
  for (const LightGeometry& geometry : seen) {
    DaylightSample sample{kBrdf * (7e4 * geometry.sun + 0.5 * geometry.sky), {}, geometry};
    sample.sigma = 0.02 * sample.true_color;
    samples.push_back(sample);
  }
  return samples;
}

std::string BestAfter(const std::vector<LightGeometry>& seen) {
  const std::vector<DaylightSample> samples = SamplesAt(seen);
  const DaylightFit fit = FitDaylight(samples, kBrdf, true, {});
  const auto best = BestFurtherSample(samples, fit, kBrdf, true, {});
  return best ? best->where.text() : "";
}

const LightGeometry kSun = {0.7 * kSolarSolidAngle, 0, 2},
                    kPaleSun = {0.2 * kSolarSolidAngle, 0, 2}, kShade = {0, 0, 2};

TEST(BestFurtherSample, IsInTheLightThatIsMissing) {
  EXPECT_NE(BestAfter({kPaleSun, kShade, kShade, kShade}).find("sun"), std::string::npos);
  EXPECT_NE(BestAfter({kSun, kPaleSun, kSun, kSun}).find("shade"), std::string::npos);
}

TEST(BestFurtherSample, NoneWhereManyTellEnough) {
  std::vector<LightGeometry> seen;
  for (int i = 0; i < 12; ++i) seen.insert(seen.end(), {kSun, kShade});
  EXPECT_EQ(BestAfter(seen), "");
}

TEST(BestFurtherSample, OfHazeIsFartherOffThanAllOthers) {
  const Spectrum horizon = Spectrum::Constant(1), dark = Spectrum::Constant(0.1);
  std::vector<HazeSample> samples;
  for (const double distance : {20.0, 25.0, 40.0}) {
    samples.push_back({ApparentColor(dark, {horizon, Spectrum::Constant(0.999)}, distance),
                       Spectrum::Constant(0.003), distance});
  }
  const AtmosphereFit fit = FitAtmosphere(samples, horizon, {});
  const auto best = BestFurtherSample(samples, fit, {});
  ASSERT_TRUE(best);
  EXPECT_NEAR(best->distance, 80, 1e-9);
  EXPECT_LT(best->left, 0.5);
}

}  // namespace
}  // namespace insitu
