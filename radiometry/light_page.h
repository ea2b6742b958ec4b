// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a measurement of light as JSON, and the page made from that JSON alone.
#pragma once

#include <json/value.h>

#include <string>

#include "calibration/program/site.h"
#include "radiometry/light_measurement.h"

namespace insitu {

// Verdict, samples with residuals on their photographs, spectra of sun and sky with their standard
// deviations and colour temperatures, a cloudless sky's beside them, haze, what a further sample
// should be. `site` is for the photographs.
Json::Value LightPageReport(const SitePaths& site, const LightMeasurement& measured);

// work/light/report.json and report.html.
void WriteLightPage(const SitePaths& site, const Json::Value& report);

// "Verdict review: 2 objections, see .../report.html" and a line for each, with its remedy.
std::string VerdictLines(const SitePaths& site, const Json::Value& report);

}  // namespace insitu
