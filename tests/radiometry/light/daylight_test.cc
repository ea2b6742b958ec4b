// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/daylight.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
const Eigen::Vector3d kZenith = Eigen::Vector3d(0.1, -0.2, 0.97).normalized();

bool Always(const Eigen::Vector3d&) { return true; }
bool Never(const Eigen::Vector3d&) { return false; }

Daylight SomeDaylight() {
  Daylight light;
  light.zenith_direction = kZenith;
  light.sun_direction = (kZenith + kZenith.unitOrthogonal()).normalized();  // 45 degrees high
  light.sun_radiance = Spectrum::LinSpaced(5e4, 8e4);
  light.ambient_radiance = Spectrum::Constant(0.1);
  light.sky_radiance = Spectrum::LinSpaced(0.9, 0.4);
  return light;
}

TEST(IrradianceElement, Eq1_IsRadianceTimesProjectedSolidAngle) {
  const Spectrum radiance = Spectrum::LinSpaced(1, 2);
  EXPECT_TRUE((IrradianceElement(radiance, 0.5, 0.25) == radiance * 0.125).all());
}

class SkyFacetsTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(PolarFacets, SkyFacetsTest, testing::Values(1, 2, 3, 8));

TEST_P(SkyFacetsTest, SolidAnglesSumToTwoPi) {
  const SkyFacets facets = MakeSkyFacets(kZenith, GetParam());
  ASSERT_EQ(facets.directions.size(), 4u * GetParam() * GetParam());
  EXPECT_NEAR(facets.solid_angle * facets.directions.size(), 2 * kPi, 1e-12);
}

TEST_P(SkyFacetsTest, AreUnitDirectionsAboveTheHorizonAndDistinct) {
  const SkyFacets facets = MakeSkyFacets(kZenith, GetParam());
  for (size_t i = 0; i < facets.directions.size(); ++i) {
    EXPECT_NEAR(facets.directions[i].norm(), 1, 1e-14);
    EXPECT_GT(facets.directions[i].dot(kZenith), 0);
    for (size_t k = 0; k < i; ++k) {
      EXPECT_GT((facets.directions[i] - facets.directions[k]).norm(), 0.1 / GetParam());
    }
  }
}

TEST_P(SkyFacetsTest, EveryFourthFacetAloneCoversTheSkyEvenly) {
  const SkyFacets facets = MakeSkyFacets(kZenith, GetParam());
  for (size_t first = 0; first < 4; ++first) {
    double projected = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t i = first; i < facets.directions.size(); i += 4) {
      projected += 4 * facets.solid_angle * facets.directions[i].dot(kZenith);
      sum += 4 * facets.solid_angle * facets.directions[i];
    }
    EXPECT_NEAR(projected, kPi, 1e-12);
    if (GetParam() > 1) {  // one band: a single facet cannot be symmetric
      EXPECT_LT((sum - kPi * kZenith).norm(), 1e-12);
    }
  }
}

TEST(SkyFacets, RefusesNone) { EXPECT_THROW(MakeSkyFacets(kZenith, 0), CheckError); }

TEST(SunIrradiance, Eq3_FollowsTheCosineOfIncidence) {
  const Daylight light = SomeDaylight();
  const LightGeometry seen =
      MeasureLight(light, MakeSkyFacets(kZenith, 2), light.zenith_direction, Always);
  const Spectrum expected = light.sun_radiance * (std::sqrt(0.5) * kSolarSolidAngle);
  EXPECT_LT((SunIrradiance(light, seen) - expected).abs().maxCoeff(), 1e-12);
}

TEST(SunIrradiance, Eq3_IsZeroBehindAndInShadow) {
  const Daylight light = SomeDaylight();
  const SkyFacets facets = MakeSkyFacets(kZenith, 2);
  EXPECT_EQ(MeasureLight(light, facets, -light.sun_direction, Always).sun, 0);
  EXPECT_EQ(MeasureLight(light, facets, light.sun_direction, Never).sun, 0);
}

TEST(SunIrradiance, Eq3_HalfTheDiscGivesHalfTheLight) {
  const Daylight light = SomeDaylight();
  const Eigen::Vector3d across = light.sun_direction.unitOrthogonal();
  const LightGeometry seen =
      MeasureLight(light, MakeSkyFacets(kZenith, 2), light.sun_direction,
                   [&](const Eigen::Vector3d& to_light) { return to_light.dot(across) > 0; });
  EXPECT_NEAR(seen.sun, kSolarSolidAngle / 2, kSolarSolidAngle / 16);
}

// Half of what stands in the way of a disc stands in the way of its middle, or does not.
TEST(SunIrradiance, Eq3_AsPrintedTheSunIsOneDirection) {
  Daylight light;
  light.sun_direction = Eigen::Vector3d(0.6, 0, 0.8);
  light.sun_solid_angle = kPrintedSolidAngle;
  light.sun_is_one_direction = true;
  for (const Eigen::Vector3d& point : SunPoints(light)) {
    EXPECT_LT((point - light.sun_direction).norm(), 1e-15);
  }
  const auto beside = [](const Eigen::Vector3d& d) { return d.x() < 0.6001; };
  const LightGeometry seen = MeasureLight(light, {}, Eigen::Vector3d::UnitZ(), beside);
  EXPECT_NEAR(seen.sun, 0.8 * 4e-4, 1e-12);
}

TEST(AmbientIrradiance, Eq4_IsPiTimesRadianceWhateverStandsAround) {
  const Daylight light = SomeDaylight();
  const LightGeometry seen = MeasureLight(light, MakeSkyFacets(kZenith, 2), -kZenith, Never);
  EXPECT_LT((AmbientIrradiance(light, seen) - light.ambient_radiance * kPi).abs().maxCoeff(),
            1e-15);
}

TEST(SkyIrradiance, Eq5_EqualsEq4UnderTheOpenSky) {
  Daylight light = SomeDaylight();
  light.ambient_radiance = light.sky_radiance;
  for (const int m : {1, 2, 8}) {
    const LightGeometry seen = MeasureLight(light, MakeSkyFacets(kZenith, m), kZenith, Always);
    const Spectrum difference = SkyIrradiance(light, seen) - AmbientIrradiance(light, seen);
    EXPECT_LT(difference.abs().maxCoeff(), 1e-12);
  }
}

TEST(SkyIrradiance, Eq5_AWallSeesHalfTheSky) {
  const Daylight light = SomeDaylight();
  const LightGeometry seen =
      MeasureLight(light, MakeSkyFacets(kZenith, 16), kZenith.unitOrthogonal(), Always);
  EXPECT_NEAR(seen.sky, kPi / 2, 0.01);
}

TEST(SkyIrradiance, Eq5_ASurfaceFacingDownSeesNone) {
  const Daylight light = SomeDaylight();
  EXPECT_EQ(MeasureLight(light, MakeSkyFacets(kZenith, 8), -kZenith, Always).sky, 0);
}

TEST(SkyIrradiance, Eq5_AnObstacleUpToFortyFiveDegreesTakesHalf) {
  // Of a uniform sky the part above elevation e lights the ground with pi (1 - sin^2 e).
  const Daylight light = SomeDaylight();
  const LightGeometry seen = MeasureLight(
      light, MakeSkyFacets(kZenith, 32), kZenith,
      [](const Eigen::Vector3d& to_light) { return to_light.dot(kZenith) > std::sqrt(0.5); });
  EXPECT_NEAR(seen.sky, kPi / 2, 2 * kPi * std::sqrt(0.5) * 0.5 / 32);  // half a band
}

TEST(TotalIrradiance, IsTheSumOfItsParts) {
  const Daylight light = SomeDaylight();
  const LightGeometry seen{1e-5, kPi, 2};
  const Spectrum sum =
      SunIrradiance(light, seen) + AmbientIrradiance(light, seen) + SkyIrradiance(light, seen);
  EXPECT_TRUE((TotalIrradiance(light, seen) == sum).all());
}

}  // namespace
}  // namespace insitu
