// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/sun_verdict.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const GeographicPlace kPlace = {46.95, 7.44, 540};
constexpr double kSigma = 0.09 * kDegree;

// Tangential, as a unit vector's is.
Matrix3d Covariance(const Vector3d& unit, double sigma) {
  return sigma * sigma * (Matrix3d::Identity() - unit * unit.transpose());
}

class SunVerdicts : public testing::Test {
 protected:
  // The sun of a time, seen in a world turned by `turn` about its zenith, against circumstances.
  std::optional<SunVerdict> Judge(const std::string& true_time, const std::string& stated_time,
                                  double turn = 0) {
    const SunPosition sun = PositionOfSun(*JulianDayOf(true_time), kPlace);
    const Vector3d north = Eigen::AngleAxisd(-turn, Vector3d::UnitZ()) * Vector3d::UnitY();
    const Vector3d unit = SunDirection(sun, north, Vector3d::UnitZ());
    SunCircumstances circumstances{kPlace, Vector3d::UnitY(), stated_time, "site.json"};
    if (!has_north_) circumstances.true_north.reset();
    return JudgeSun({unit, Covariance(unit, kSigma)},
                    {Vector3d::UnitZ(), Covariance(Vector3d::UnitZ(), 1e-4)}, circumstances);
  }
  bool has_north_ = true;
};

TEST_F(SunVerdicts, AgreesWithTheAlmanac) {
  const auto verdict = Judge("2024-05-15T09:45:00+02:00", "2024-05-15T09:45:00+02:00");
  ASSERT_TRUE(verdict);
  EXPECT_TRUE(verdict->agrees) << verdict->message;
  EXPECT_NEAR(verdict->sigma_elevation, std::hypot(kSigma, 1e-4), 1e-6);
  EXPECT_NEAR(verdict->sigma_azimuth * std::cos(verdict->measured.elevation), kSigma, 1e-4);
  EXPECT_FALSE(verdict->clock_minutes);
}

TEST_F(SunVerdicts, NamesAMissingSummerTime) {
  const auto verdict = Judge("2024-05-15T09:45:00+02:00", "2024-05-15T09:45:00+01:00");
  ASSERT_TRUE(verdict && verdict->clock_minutes);
  EXPECT_NEAR(*verdict->clock_minutes, -60, 2);
  EXPECT_NE(verdict->message.find("summer time is missing"), std::string::npos) << verdict->message;
  EXPECT_FALSE(verdict->agrees);
}

TEST_F(SunVerdicts, NamesAClockErrorWithItsSize) {
  const auto verdict = Judge("2024-05-15T10:02:00+02:00", "2024-05-15T09:45:00+02:00");
  ASSERT_TRUE(verdict && verdict->clock_minutes);
  EXPECT_NEAR(*verdict->clock_minutes, 17, 2);
  EXPECT_NE(verdict->message.find("minutes slow"), std::string::npos);
}

TEST_F(SunVerdicts, NamesAWrongNorthWithItsSize) {
  const auto verdict = Judge("2024-05-15T09:45:00+02:00", "2024-05-15T09:45:00+02:00", 4 * kDegree);
  ASSERT_TRUE(verdict && verdict->north_deg);
  EXPECT_NEAR(*verdict->north_deg, 4, 0.01);
  EXPECT_FALSE(verdict->clock_minutes);  // the elevation fits: no clock explains the azimuth alone
}

TEST_F(SunVerdicts, TriesBothClocksWithoutAnOffset) {
  const auto verdict = Judge("2024-05-15T09:45:00+02:00", "2024-05-15T09:45:00");
  ASSERT_TRUE(verdict);
  EXPECT_TRUE(verdict->agrees);
  EXPECT_EQ(verdict->almanac.local_time, "2024-05-15T09:45:00+02:00");
  ASSERT_EQ(verdict->others.size(), 2u);  // UTC, and UTC + 1 h
  EXPECT_NE(verdict->message.find("2024-05-15T09:45:00+01:00"), std::string::npos);
}

TEST_F(SunVerdicts, WithoutNorthElevationsAlone) {
  has_north_ = false;
  EXPECT_TRUE(
      Judge("2024-05-15T09:45:00+02:00", "2024-05-15T09:45:00+02:00", 40 * kDegree)->agrees);
  EXPECT_FALSE(Judge("2024-05-15T09:45:00+02:00", "2024-05-15T09:45:00+01:00")->agrees);
  EXPECT_FALSE(Judge("2024-05-15T09:45:00+02:00", "yesterday"));
}

}  // namespace
}  // namespace insitu
