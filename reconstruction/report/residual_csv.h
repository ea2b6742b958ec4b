// SPDX-License-Identifier: GPL-3.0-or-later
// The residual report's tables, which tie points make too long for the report itself.
#pragma once

#include <string>

#include "reconstruction/adjustment/adjusted_survey.h"

namespace insitu {

// Every observation, and every point with its covariance: a header line, then one line each.
std::string ObservationsCsv(const Adjustment& adjustment);
std::string PointsCsv(const Adjustment& adjustment);

}  // namespace insitu
