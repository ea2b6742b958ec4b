// SPDX-License-Identifier: GPL-3.0-or-later
// The directions to the sun and the zenith, and what the almanac says of the sun.
#pragma once

#include <json/value.h>

#include <optional>

#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/survey/survey.h"
#include "renderer/live/live_solution.h"

namespace insitu {

// {azimuth_deg, elevation_deg, sigma_deg, pairs, ephemeris}; null without sun pairs. Without a site
// the azimuth counts from the y axis.
Json::Value LiveSun(const Survey& survey, const SolvedSurvey& solved,
                    const std::optional<LiveSite>& site);

// {tilt_deg, sigma_deg, pairs}: of the zenith from the z axis; null without zenith pairs.
Json::Value LiveZenith(const Survey& survey, const SolvedSurvey& solved);

}  // namespace insitu
