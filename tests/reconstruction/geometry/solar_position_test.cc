// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/solar_position.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace insitu {
namespace {

constexpr double kDegree = M_PI / 180;

double JulianDay(const std::string& text) { return JulianDayOf(text).value(); }

// Meeus, example 25.a: 1992 October 13, 0h TD. By the low accuracy formulae 198.38083 and -7.78507;
// by the whole theory (25.b) 198.378178 and -7.783871.
TEST(ApparentSun, IsThatOfMeeus) {
  const SunAmongStars sun = ApparentSun(2448908.5);
  EXPECT_NEAR(sun.right_ascension / kDegree, 198.38083, 1e-5);
  EXPECT_NEAR(sun.declination / kDegree, -7.78507, 1e-5);
  EXPECT_NEAR(sun.distance, 0.99766, 1e-5);
}

// Reda & Andreas, NREL/TP-560-34302, table A5.1: zenith 50.11162, azimuth 194.34024.
TEST(PositionOfSun, IsWithinAHundredthOfADegreeOfNrel) {
  const SunPosition sun =
      PositionOfSun(JulianDay("2003-10-17T12:30:30-07:00"), {39.742476, -105.1786, 1830.14});
  RecordProperty("zenith", std::to_string(90 - sun.elevation / kDegree));
  RecordProperty("azimuth", std::to_string(sun.azimuth / kDegree));
  EXPECT_NEAR(90 - sun.elevation / kDegree, 50.11162, 0.007);
  EXPECT_NEAR(sun.azimuth / kDegree, 194.34024, 0.007);
}

TEST(PositionOfSun, IsHighestInTheSouthAtNoon) {
  // Equinox, on the equator, at the meridian of the equation of time's noon.
  const SunPosition noon = PositionOfSun(JulianDay("2024-03-20T12:07:25Z"), {0, 0, 0});
  EXPECT_NEAR(noon.elevation / kDegree, 90, 0.3);
  const SunPosition morning = PositionOfSun(JulianDay("2024-06-20T08:00:00+02:00"), {47, 8.5, 500});
  EXPECT_GT(morning.azimuth / kDegree, 60);
  EXPECT_LT(morning.azimuth / kDegree, 100);
}

TEST(JulianDayOf, ReadsWhatSitesState) {
  EXPECT_EQ(JulianDay("2000-01-01T12:00:00Z"), 2451545);
  EXPECT_EQ(JulianDay("1957-10-04T19:26:24Z"), 2436116.31);  // Meeus, example 7.a
  EXPECT_NEAR(JulianDay("2024-05-15T09:45:00+02:00"), JulianDay("2024-05-15T07:45Z"), 1e-9);
  EXPECT_NEAR(JulianDay("2024-02-29T23:30:30.5-0130"), JulianDay("2024-03-01T01:00:30.5Z"), 1e-9);
  for (const char* text :
       {"2024-05-15T09:45:00", "2024-02-30T09:45:00Z", "2024-05-15", "", "2024-05-15T09:61:00Z",
        "2024-05-15T09:45:00+2", "2024-05-15T09:45x+02:00", "2024-05-15T09:45:00+02:00x"}) {
    EXPECT_FALSE(JulianDayOf(text)) << text;
  }
}

TEST(SunDirection, InvertsPositionOfDirection) {
  const Eigen::Vector3d north = Eigen::Vector3d(-0.6, 0.8, 0.006).normalized();
  const Eigen::Vector3d zenith = Eigen::Vector3d(0.01, -0.004, 1).normalized();
  const SunPosition sun{1.9, 0.7};
  const SunPosition again = PositionOfDirection(SunDirection(sun, north, zenith), north, zenith);
  EXPECT_NEAR(again.azimuth, 1.9, 1e-12);
  EXPECT_NEAR(again.elevation, 0.7, 1e-12);
  // North up the page: east is to its right.
  const Eigen::Vector3d east =
      SunDirection({M_PI / 2, 0}, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ());
  EXPECT_LT((east - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

TEST(FindClockError, FindsAnHourOfSummerTime) {
  const GeographicPlace place{47.4, 8.5, 500};
  const double truth = JulianDay("2024-05-15T09:45:00+02:00");
  SunPosition measured = PositionOfSun(truth, place);
  const ClockError hour = FindClockError(measured, truth - 1.0 / 24, place);
  EXPECT_NEAR(hour.minutes, 60, 0.01);
  EXPECT_LT(hour.remaining, 1e-6);
  EXPECT_NEAR(FindClockError(measured, truth, place).minutes, 0, 0.01);
  // What lies across the sun's way no clock explains.
  measured.elevation += 0.02;
  const ClockError across = FindClockError(measured, truth, place);
  EXPECT_GT(across.remaining, 0.01);
  EXPECT_LT(across.remaining, 0.02);
}

}  // namespace
}  // namespace insitu
