// SPDX-License-Identifier: GPL-3.0-or-later
// The directions to the sun and the zenith, and what the almanac says of the sun.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <optional>

#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/geometry/solar_position.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// What the almanac needs, of site.json.
struct LiveSite {
  GeographicPlace place;
  Eigen::Vector3d true_north;        // unit, world
  std::optional<double> julian_day;  // UTC; nullopt: no time, or none that says its offset
};

// {azimuth_deg, elevation_deg, sigma_deg, pairs, ephemeris}; null without sun pairs. Without a site
// the azimuth counts from the y axis.
Json::Value LiveSun(const Survey& survey, const SolvedSurvey& solved,
                    const std::optional<LiveSite>& site);

// {tilt_deg, sigma_deg, pairs}: of the zenith from the z axis; null without zenith pairs.
Json::Value LiveZenith(const Survey& survey, const SolvedSurvey& solved);

}  // namespace insitu
