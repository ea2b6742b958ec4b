// SPDX-License-Identifier: GPL-3.0-or-later
// When and where a site's photographs were taken, as far as site.json and they themselves tell.
#pragma once

#include <optional>

#include "calibration/program/site.h"
#include "reconstruction/site_photos.h"
#include "reconstruction/survey/survey.h"
#include "reconstruction/verdict/sun_verdict.h"

namespace insitu {

// Of site.json what stands there (latitude, longitude, altitude_m, true_north, local_time,
// time_zone), the rest of the first photograph that shows a shadow of a sun pair and tells it. A
// time without offset from UTC gets that of time_zone, "+02:00". nullopt: no place, or no time.
// Throws InputError: a value in site.json that is none.
std::optional<SunCircumstances> SunCircumstancesOf(const SitePaths& site, const SitePhotos& photos,
                                                   const Survey& survey);

}  // namespace insitu
