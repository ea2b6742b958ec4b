// SPDX-License-Identifier: GPL-3.0-or-later
// Where the sun stands by the almanac, to be held against the direction that shadows show.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace insitu {

struct GeographicPlace {
  double latitude = 0, longitude = 0;  // [deg], north and east positive
  double altitude = 0;                 // [m]
};

struct SunPosition {
  double azimuth = 0;    // [rad], from true north over east, 0..2 pi
  double elevation = 0;  // [rad], over the horizon, as seen: refracted
};

// The sun's apparent place among the stars. [Meeus, Astronomical Algorithms, 2nd ed., ch. 25, low
// accuracy: 0.01 deg] `julian_day` in terrestrial time.
struct SunAmongStars {
  double right_ascension = 0, declination = 0;  // [rad], of date
  double distance = 1;                          // [AU]
};
SunAmongStars ApparentSun(double julian_day);

// `julian_day` in UTC. The years 1990 to 2050: terrestrial time is taken as UTC + 69 s. Pressure is
// the standard atmosphere's at the altitude, temperature 11 C: near the horizon they count.
SunPosition PositionOfSun(double julian_day, const GeographicPlace& place);

// "2024-05-15T09:45:00+02:00" as Julian day in UTC; seconds and their fraction may be missing, Z is
// UTC. nullopt: no such date, or the offset from UTC is missing.
std::optional<double> JulianDayOf(const std::string& local_time);

// The unit vector to the sun in a world frame whose true north and zenith are given.
Eigen::Vector3d SunDirection(const SunPosition& sun, const Eigen::Vector3d& true_north,
                             const Eigen::Vector3d& zenith);

// The inverse; `true_north` needs not be level.
SunPosition PositionOfDirection(const Eigen::Vector3d& to_sun, const Eigen::Vector3d& true_north,
                                const Eigen::Vector3d& zenith);

double AngleBetween(const SunPosition& a, const SunPosition& b);  // [rad]

// How far the clock would have to be wrong for the almanac to agree with a measured direction.
struct ClockError {
  double minutes = 0;    // to be added to the clock's time, within half a day
  double remaining = 0;  // [rad], the angle that no time explains
};
ClockError FindClockError(const SunPosition& measured, double julian_day,
                          const GeographicPlace& place);

}  // namespace insitu
