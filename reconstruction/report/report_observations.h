// SPDX-License-Identifier: GPL-3.0-or-later
// Observations in the report: those flagged, those weakly controlled, and how test values spread.
// The keys of the JSON are the report's format.
#pragma once

#include <json/value.h>

#include "reconstruction/adjustment/adjusted_survey.h"

namespace insitu {

Json::Value ObservationsSection(const Adjustment& adjustment);
Json::Value HistogramSection(const Adjustment& adjustment);

}  // namespace insitu
