// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/sun_verdict.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "calibration/files/wording.h"
#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

constexpr double kSunSigmas = 3;
constexpr double kLeastDifference = 0.25 * kDegree;  // a shadow's edge is half a degree wide
constexpr double kHourTolerance = 8;                 // [min], about a whole hour
constexpr int kHalfDay = 720;                        // [min]

double WithinHalfTurn(double angle) { return std::remainder(angle, 2 * M_PI); }

// Azimuths count by the arc they make on the sky.
struct SunDifference {
  double elevation = 0, azimuth = 0;  // [rad], measured - almanac; the azimuth not yet as an arc
  double Arc(double elevation_of) const {
    return std::hypot(elevation, azimuth * std::cos(elevation_of));
  }
};

SunDifference DifferenceFrom(const SunVerdict& verdict, const SunPosition& sun) {
  const double azimuth =
      verdict.has_azimuth ? WithinHalfTurn(verdict.measured.azimuth - sun.azimuth) : 0;
  return {verdict.measured.elevation - sun.elevation, azimuth};
}

// Of elevation and azimuth, sun and zenith taken as independent.
void AddSigmas(const Direction& sun, const Direction& zenith, const Eigen::Vector3d& north,
               SunVerdict* verdict) {
  constexpr double kStep = 1e-6;
  const SunPosition at = verdict->measured;
  double elevation = 0, azimuth = 0;
  for (const bool is_sun : {true, false}) {
    Eigen::RowVector3d of_elevation, of_azimuth;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const SunPosition moved =
          PositionOfDirection(is_sun ? (sun.unit + step).normalized() : sun.unit, north,
                              is_sun ? zenith.unit : (zenith.unit + step).normalized());
      of_elevation[axis] = (moved.elevation - at.elevation) / kStep;
      of_azimuth[axis] = WithinHalfTurn(moved.azimuth - at.azimuth) / kStep;
    }
    const Eigen::Matrix3d& covariance = is_sun ? sun.covariance : zenith.covariance;
    elevation += of_elevation * covariance * of_elevation.transpose();
    azimuth += of_azimuth * covariance * of_azimuth.transpose();
  }
  verdict->sigma_elevation = std::sqrt(std::max(elevation, 0.0));
  verdict->sigma_azimuth = std::sqrt(std::max(azimuth, 0.0));
}

std::string WithOffset(const std::string& local_time, int hours) {
  return local_time + Formatted("%c%02d:00", hours < 0 ? '-' : '+', std::abs(hours));
}

// The time as it stands, else by the clocks of the place: legal time is that of the sun's zone or
// the next one, and summer time an hour more.
std::vector<SunVerdict::Almanac> Almanacs(const SunCircumstances& circumstances) {
  std::vector<std::string> times = {circumstances.local_time};
  if (!JulianDayOf(times[0])) {
    const int zone = static_cast<int>(std::lround(circumstances.place.longitude / 15));
    times.clear();
    for (const int hours : {zone, zone + 1, zone + 2}) {
      times.push_back(WithOffset(circumstances.local_time, hours));
    }
  }
  std::vector<SunVerdict::Almanac> almanacs;
  for (const std::string& time : times) {
    const auto day = JulianDayOf(time);
    if (day) almanacs.push_back({time, PositionOfSun(*day, circumstances.place)});
  }
  return almanacs;
}

bool Agrees(const SunVerdict& verdict, const SunPosition& sun) {
  const SunDifference difference = DifferenceFrom(verdict, sun);
  const double arc = std::cos(verdict.measured.elevation);
  return std::abs(difference.elevation) <=
             std::max(kSunSigmas * verdict.sigma_elevation, kLeastDifference) &&
         arc * std::abs(difference.azimuth) <=
             std::max(kSunSigmas * arc * verdict.sigma_azimuth, kLeastDifference);
}

// The least change of the clock by which the almanac agrees, to the minute.
std::optional<double> ClockThatAgrees(const SunVerdict& verdict, const GeographicPlace& place) {
  const double day = *JulianDayOf(verdict.almanac.local_time);
  std::optional<double> best;
  double least = M_PI;
  for (int minutes = -kHalfDay; minutes <= kHalfDay; ++minutes) {
    const SunPosition sun = PositionOfSun(day + minutes / 1440.0, place);
    if (!Agrees(verdict, sun)) continue;
    const double arc = DifferenceFrom(verdict, sun).Arc(sun.elevation);
    const bool is_same_side = best && std::abs(minutes - *best) < 60;
    const bool is_better =
        !best || (is_same_side ? arc < least : std::abs(minutes) < std::abs(*best));
    if (!is_better) continue;
    least = arc;
    best = minutes;
  }
  return best;
}

std::string InDegrees(double angle) { return Number("%.2f", angle / kDegree); }

std::string SaidDirections(const SunVerdict& verdict) {
  std::string said = "the shadows show the sun at an elevation of " +
                     InDegrees(verdict.measured.elevation) + " +- " +
                     InDegrees(verdict.sigma_elevation) + " deg";
  if (verdict.has_azimuth) {
    said += ", azimuth " + InDegrees(verdict.measured.azimuth) + " +- " +
            InDegrees(verdict.sigma_azimuth) + " deg";
  }
  const auto almanac = [&](const SunVerdict::Almanac& each) {
    return InDegrees(each.sun.elevation) +
           (verdict.has_azimuth ? " and " + InDegrees(each.sun.azimuth) : "") + " deg at " +
           each.local_time;
  };
  said += "; by the almanac it stood at " + almanac(verdict.almanac);
  for (const SunVerdict::Almanac& other : verdict.others) said += ", or at " + almanac(other);
  said += " (" + verdict.source + ")";
  const SunDifference difference = DifferenceFrom(verdict, verdict.almanac.sun);
  return said + ": " + InDegrees(difference.elevation) + " deg in elevation" +
         (verdict.has_azimuth ? " and " + InDegrees(difference.azimuth) + " deg in azimuth" : "");
}

std::string SaidExplanations(const SunVerdict& verdict) {
  std::vector<std::string> reasons;
  if (verdict.clock_minutes) {
    const double minutes = *verdict.clock_minutes;
    const double hours = std::round(minutes / 60);
    const bool is_hour = hours != 0 && std::abs(minutes - 60 * hours) < kHourTolerance;
    reasons.push_back("a clock that is " + Number("%.0f", std::abs(minutes)) + " minutes " +
                      (minutes > 0 ? "slow" : "fast") +
                      (is_hour && std::abs(hours) == 1
                           ? ", as where summer time is missing or counted twice"
                       : is_hour ? ", as by another time zone"
                                 : ""));
  }
  if (verdict.north_deg) {
    reasons.push_back("a true north that is wrong by " + Number("%.2f", *verdict.north_deg) +
                      " deg");
  }
  if (reasons.empty())
    return "no clock and no north explains it: check the sun pairs, the place and the date";
  return "explained by " + reasons[0] + (reasons.size() > 1 ? ", or by " + reasons[1] : "");
}

Json::Value AlmanacJson(const SunVerdict::Almanac& almanac) {
  Json::Value json;
  json["local_time"] = almanac.local_time;
  json["elevation_deg"] = almanac.sun.elevation / kDegree;
  json["azimuth_deg"] = almanac.sun.azimuth / kDegree;
  return json;
}

}  // namespace

Json::Value SunVerdict::ToJson() const {
  Json::Value json;
  json["agrees"] = agrees;
  json["message"] = message;
  json["elevation_deg"] = measured.elevation / kDegree;
  json["sigma_elevation_deg"] = sigma_elevation / kDegree;
  if (has_azimuth) json["azimuth_deg"] = measured.azimuth / kDegree;
  if (has_azimuth) json["sigma_azimuth_deg"] = sigma_azimuth / kDegree;
  json["almanac"] = AlmanacJson(almanac);
  json["other_clocks"] = Json::Value(Json::arrayValue);
  for (const Almanac& other : others) json["other_clocks"].append(AlmanacJson(other));
  json["clock_minutes"] = clock_minutes ? Json::Value(*clock_minutes) : Json::Value();
  json["north_deg"] = north_deg ? Json::Value(*north_deg) : Json::Value();
  return json;
}

std::optional<SunVerdict> JudgeSun(const Direction& sun, const Direction& zenith,
                                   const SunCircumstances& circumstances) {
  SunVerdict verdict;
  verdict.has_azimuth = circumstances.true_north.has_value();
  verdict.source = "time of " + circumstances.source;
  const Eigen::Vector3d north = circumstances.true_north.value_or(Eigen::Vector3d::UnitY());
  verdict.measured = PositionOfDirection(sun.unit, north, zenith.unit);
  AddSigmas(sun, zenith, north, &verdict);
  verdict.others = Almanacs(circumstances);
  if (verdict.others.empty()) return std::nullopt;
  const auto nearest = std::min_element(
      verdict.others.begin(), verdict.others.end(), [&](const auto& a, const auto& b) {
        return DifferenceFrom(verdict, a.sun).Arc(a.sun.elevation) <
               DifferenceFrom(verdict, b.sun).Arc(b.sun.elevation);
      });
  verdict.almanac = *nearest;
  verdict.others.erase(nearest);
  verdict.agrees = Agrees(verdict, verdict.almanac.sun);
  verdict.message = SaidDirections(verdict);
  if (verdict.agrees) return verdict;
  verdict.clock_minutes = ClockThatAgrees(verdict, circumstances.place);
  const SunDifference difference = DifferenceFrom(verdict, verdict.almanac.sun);
  const double allowed = std::max(kSunSigmas * verdict.sigma_elevation, kLeastDifference);
  if (verdict.has_azimuth && std::abs(difference.elevation) <= allowed)
    verdict.north_deg = difference.azimuth / kDegree;
  verdict.message += "; " + SaidExplanations(verdict);
  return verdict;
}

}  // namespace insitu
