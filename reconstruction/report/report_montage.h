// SPDX-License-Identifier: GPL-3.0-or-later
// How well the points of a montage are known in each photo.
// The keys of the JSON are the report's format.
#pragma once

#include <json/value.h>

#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/report/report_context.h"

namespace insitu {

Json::Value MontageSection(const Adjustment& adjustment, const std::vector<MontagePoint>& points);

}  // namespace insitu
