// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/solar_position.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

constexpr double kMinutesADay = 1440;
constexpr double kTerrestrialMinusUtc = 69;  // [s]
constexpr double kParallax = 8.794 / 3600 * kDegree;
constexpr double kTemperature = 11;  // [C]

double Centuries(double julian_day) { return (julian_day - 2451545) / 36525; }

// Longitude of the moon's ascending node, on which nutation mostly depends.
double MoonNode(double t) { return (125.04 - 1934.136 * t) * kDegree; }

double Obliquity(double t) {
  const double seconds = 21.448 - t * (46.8150 + t * (0.00059 - t * 0.001813));
  return (23 + (26 + seconds / 60) / 60 + 0.00256 * std::cos(MoonNode(t))) * kDegree;
}

// Greenwich apparent sidereal time as an angle; `julian_day` in UTC. [Meeus, ch. 12]
double SiderealTime(double julian_day) {
  const double t = Centuries(julian_day);
  const double mean = 280.46061837 + 360.98564736629 * (julian_day - 2451545) +
                      t * t * (0.000387933 - t / 38710000);
  const double nutation = -0.00478 * std::sin(MoonNode(t)) * std::cos(Obliquity(t));
  return (mean + nutation) * kDegree;
}

// How much higher the sun is seen than it stands. [Reda & Andreas 2004, eq. 42]
double Refraction(double elevation, double altitude) {
  const double degrees = elevation / kDegree;
  if (degrees < -0.8) return 0;  // it has set
  const double pressure = 1013.25 * std::pow(std::max(0.0, 1 - 2.25577e-5 * altitude), 5.25588);
  return pressure / 1010 * 283 / (273 + kTemperature) * 1.02 /
         (60 * std::tan((degrees + 10.3 / (degrees + 5.11)) * kDegree)) * kDegree;
}

double Turned(double angle) {
  const double turned = std::fmod(angle, 2 * M_PI);
  return turned < 0 ? turned + 2 * M_PI : turned;
}

Eigen::Vector3d InHorizon(const SunPosition& sun) {  // east, north, up
  return {std::cos(sun.elevation) * std::sin(sun.azimuth),
          std::cos(sun.elevation) * std::cos(sun.azimuth), std::sin(sun.elevation)};
}

struct Horizon {
  Eigen::Vector3d east, north, up;
};

Horizon HorizonOf(const Eigen::Vector3d& true_north, const Eigen::Vector3d& zenith) {
  const Eigen::Vector3d up = zenith.normalized(), east = true_north.cross(up).normalized();
  return {east, up.cross(east), up};
}

// Gregorian, of midnight. [Meeus, ch. 7]
double JulianDayOfDate(int year, int month, int day) {
  if (month <= 2) {
    --year;
    month += 12;
  }
  const int century = year / 100, leap_centuries = century / 4;
  return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day +
         (2 - century + leap_centuries) - 1524.5;
}

int DaysOfMonth(int year, int month) {
  static constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return month == 2 && is_leap ? 29 : kDays[month - 1];
}

// [days] of "Z", "+02:00", "-0500"; nullopt: none.
std::optional<double> UtcOffset(const std::string& text) {
  if (text == "Z") return 0;
  char sign = 0, end = 0;
  int hours = 0, minutes = 0;
  const bool has_colon = text.find(':') != std::string::npos;
  const char* const format = has_colon ? "%c%2d:%2d%c" : "%c%2d%2d%c";
  if (std::sscanf(text.c_str(), format, &sign, &hours, &minutes, &end) != 3) return std::nullopt;
  if ((sign != '+' && sign != '-') || hours < 0 || hours > 14 || minutes < 0 || minutes > 59) {
    return std::nullopt;
  }
  return (sign == '+' ? 1 : -1) * (60 * hours + minutes) / kMinutesADay;
}

}  // namespace

SunAmongStars ApparentSun(double julian_day) {
  const double t = Centuries(julian_day);
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * kDegree;
  const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
  const double center = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - t * 0.000101) * std::sin(2 * anomaly) +
                        0.000289 * std::sin(3 * anomaly);
  const double longitude =
      (mean_longitude + center - 0.00569 - 0.00478 * std::sin(MoonNode(t))) * kDegree;
  const double obliquity = Obliquity(t);
  SunAmongStars sun;
  sun.right_ascension =
      Turned(std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)));
  sun.declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  sun.distance = 1.000001018 * (1 - eccentricity * eccentricity) /
                 (1 + eccentricity * std::cos(anomaly + center * kDegree));
  return sun;
}

SunPosition PositionOfSun(double julian_day, const GeographicPlace& place) {
  const SunAmongStars sun = ApparentSun(julian_day + kTerrestrialMinusUtc / 86400);
  const double hour_angle =
      SiderealTime(julian_day) + place.longitude * kDegree - sun.right_ascension;
  const double latitude = place.latitude * kDegree;
  const double sine = std::sin(latitude) * std::sin(sun.declination) +
                      std::cos(latitude) * std::cos(sun.declination) * std::cos(hour_angle);
  SunPosition position;
  position.azimuth = Turned(
      M_PI + std::atan2(std::sin(hour_angle), std::cos(hour_angle) * std::sin(latitude) -
                                                  std::tan(sun.declination) * std::cos(latitude)));
  position.elevation = std::asin(std::clamp(sine, -1.0, 1.0));
  position.elevation -= kParallax / sun.distance * std::cos(position.elevation);
  position.elevation += Refraction(position.elevation, place.altitude);
  return position;
}

std::optional<double> JulianDayOf(const std::string& local_time) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  const int read = std::sscanf(local_time.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d%n", &year, &month,
                               &day, &hour, &minute, &used);
  if (read != 5 || used == 0) return std::nullopt;
  const size_t offset_at = local_time.find_first_of("Z+-", static_cast<size_t>(used));
  if (offset_at == std::string::npos) return std::nullopt;
  const std::string seconds_text =
      local_time.substr(static_cast<size_t>(used), offset_at - static_cast<size_t>(used));
  double seconds = 0;
  char end = 0;
  if (!seconds_text.empty() && std::sscanf(seconds_text.c_str(), ":%lf%c", &seconds, &end) != 1) {
    return std::nullopt;
  }
  const bool is_date = year >= 1900 && month >= 1 && month <= 12 && day >= 1 &&
                       day <= DaysOfMonth(year, month) && hour >= 0 && hour <= 24 && minute >= 0 &&
                       minute <= 59 && seconds >= 0 && seconds < 61;
  const std::optional<double> offset = UtcOffset(local_time.substr(offset_at));
  if (!is_date || !offset) return std::nullopt;
  return JulianDayOfDate(year, month, day) + (60 * hour + minute + seconds / 60) / kMinutesADay -
         *offset;
}

Eigen::Vector3d SunDirection(const SunPosition& sun, const Eigen::Vector3d& true_north,
                             const Eigen::Vector3d& zenith) {
  const Horizon horizon = HorizonOf(true_north, zenith);
  const Eigen::Vector3d direction = InHorizon(sun);
  return direction.x() * horizon.east + direction.y() * horizon.north + direction.z() * horizon.up;
}

SunPosition PositionOfDirection(const Eigen::Vector3d& to_sun, const Eigen::Vector3d& true_north,
                                const Eigen::Vector3d& zenith) {
  const Horizon horizon = HorizonOf(true_north, zenith);
  const double east = to_sun.dot(horizon.east), north = to_sun.dot(horizon.north);
  return {Turned(std::atan2(east, north)),
          std::atan2(to_sun.dot(horizon.up), std::hypot(east, north))};
}

double AngleBetween(const SunPosition& a, const SunPosition& b) {
  const Eigen::Vector3d x = InHorizon(a), y = InHorizon(b);
  return std::atan2(x.cross(y).norm(), x.dot(y));
}

ClockError FindClockError(const SunPosition& measured, double julian_day,
                          const GeographicPlace& place) {
  constexpr double kCoarse = 10;  // [min]; over a day the angle has one minimum
  const auto angle_at = [&](double minutes) {
    return AngleBetween(measured, PositionOfSun(julian_day + minutes / kMinutesADay, place));
  };
  double best = 0, least = angle_at(0);
  for (double minutes = -kMinutesADay / 2; minutes <= kMinutesADay / 2; minutes += kCoarse) {
    const double angle = angle_at(minutes);
    if (angle >= least) continue;
    best = minutes;
    least = angle;
  }
  double low = best - kCoarse, high = best + kCoarse;
  while (high - low > 1e-4) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (angle_at(a) < angle_at(b) ? high : low) = angle_at(a) < angle_at(b) ? b : a;
  }
  best = 0.5 * (low + high);
  return {best, angle_at(best)};
}

}  // namespace insitu
