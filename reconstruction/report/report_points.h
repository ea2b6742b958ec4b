// SPDX-License-Identifier: GPL-3.0-or-later
// Points in the report: adjusted ones, tie points in sums, surveyed against adjusted ones.
// The keys of the JSON are the report's format.
#pragma once

#include <json/value.h>

#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/verdict/image_marks.h"

namespace insitu {

// The surveyed ones, in their order; if there are more than `limit`, those of the largest sigma.
Json::Value PointsSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks,
                          size_t limit);
Json::Value TiePointsSection(const Adjustment& adjustment);
Json::Value ComparisonSection(const std::vector<PointComparison>& comparisons);

}  // namespace insitu
