// SPDX-License-Identifier: GPL-3.0-or-later
// The response of a site's photographs, which are JPEG of one camera: light and curve in turn.
#pragma once

#include <json/value.h>

#include <string>

#include "calibration/program/site.h"
#include "radiometry/measure/fit_response.h"

namespace insitu {

struct ResponseMeasurement {
  ResponseFit fit;
  int places = 0, surfaces = 0;  // that it was fitted to
};

// From even places of all polygons that do not mirror and from the photographed sky, by the
// reflectance of the daylight samples' material; what their surroundings send follows from the
// curve found so far. Throws InputError: as MeasureDaylight; no sun, photographs of linear light or
// of several exposures.
ResponseMeasurement MeasureResponse(const SitePaths& site);

// As response.json (response.h), for photos/.
Json::Value ResponseJson(const ResponseMeasurement& measurement);

// A line for the terminal.
std::string BriefReport(const ResponseMeasurement& measurement);

}  // namespace insitu
