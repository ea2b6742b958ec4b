// SPDX-License-Identifier: GPL-3.0-or-later
// Where the sun stands over a site at another hour than that of its photographs.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "radiometry/natural_environment.h"
#include "reconstruction/geometry/solar_position.h"

namespace insitu {

// One of the two. A time is "16:30", of the photographs' day, or "2024-12-21T12:00", both by the
// photographs' offset from UTC unless it states another one.
struct HourRequest {
  std::string time = {};
  std::optional<SunPosition> sun = {};
};

// The name of its folder in work/hours/ and of its results: "1630" of the photographs' day,
// "2024-12-21T1200" of another, "az180_0el35_5" of a position. `day`: the photographs', as
// "2024-05-15", may be empty. Throws InputError: no time.
std::string HourName(const HourRequest& hour, const std::string& day);

// What the almanac's directions are in a site's axes.
struct SunFrame {
  // Unit, world: true_north of site.json (+y without it), turned about the measured zenith so that
  // the almanac's sun at the photographs' time has the azimuth of the measured one.
  Eigen::Vector3d north = Eigen::Vector3d::UnitY();
  Eigen::Vector3d zenith = Eigen::Vector3d::UnitZ();  // measured
  std::optional<GeographicPlace> place = {};          // nullopt: not stated
  std::string local_time = {};                        // the photographs', with offset; "": unknown
  double turned = 0;                                  // [rad], eastwards
  double elevation_difference = 0;                    // [rad], measured - almanac

  std::string Day() const { return local_time.substr(0, local_time.find('T')); }
};

// `measured`: of the site. Throws InputError: a value in site.json that is none.
SunFrame SunFrameOf(const SitePaths& site, const NaturalEnvironment& measured);

struct SiteHour {
  std::string name;      // as HourName
  std::string told;      // "2024-05-15T16:30:00+02:00", "a chosen position of the sun"
  SunPosition position;  // azimuth from true north
  Eigen::Vector3d sun;   // unit, world
  std::vector<std::string> remarks;
};

// Throws InputError: no such time, place or time of the site missing, no sun measured, the sun so
// low that its light cannot be simulated.
SiteHour SiteHourAt(const SitePaths& site, const NaturalEnvironment& measured,
                    const HourRequest& hour);

}  // namespace insitu
