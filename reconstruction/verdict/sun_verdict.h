// SPDX-License-Identifier: GPL-3.0-or-later
// The sun that shadows show against the sun of the almanac: is the clock right, and true north?
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/geometry/scene_geometry.h"
#include "reconstruction/geometry/solar_position.h"

namespace insitu {

struct SunCircumstances {
  GeographicPlace place;
  std::optional<Eigen::Vector3d> true_north;  // unit, world; nullopt: azimuths cannot be compared
  std::string local_time;                     // ISO 8601, with its offset from UTC or without
  std::string source;                         // of the time: "site.json", "EXIF of photo 'A'"
};

struct SunVerdict {
  struct Almanac {
    std::string local_time;  // with its offset from UTC
    SunPosition sun;
  };
  SunPosition measured;
  double sigma_elevation = 0, sigma_azimuth = 0;  // [rad], of what was measured
  bool has_azimuth = false;
  std::string source;
  Almanac almanac;              // of several the nearest
  std::vector<Almanac> others;  // by the other setting of a clock that does not state its offset
  std::optional<double> clock_minutes;  // to be added to the clock, if that explains a difference
  std::optional<double>
      north_deg;        // by which true north would be turned eastwards, if that explains it
  bool agrees = false;  // within 3 sigma, or a quarter of a degree
  std::string message;  // one sentence, with the remedy where it does not agree

  Json::Value ToJson() const;  // for the report, in degrees and minutes
};

// nullopt: a local time that is none.
std::optional<SunVerdict> JudgeSun(const Direction& sun, const Direction& zenith,
                                   const SunCircumstances& circumstances);

}  // namespace insitu
