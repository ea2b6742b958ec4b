// SPDX-License-Identifier: GPL-3.0-or-later
// How the report begins: what it was made from, the adjustment as a whole, its groups of
// observations and its correlations.
// The keys of the JSON are the report's format.
#pragma once

#include <json/value.h>

#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/report/report_context.h"
#include "reconstruction/verdict/image_marks.h"

namespace insitu {

Json::Value IdentitySection(const Adjustment& adjustment, const ReportContext& context);
Json::Value SummarySection(const Adjustment& adjustment, const std::vector<ImageMark>& marks);
Json::Value GroupsSection(const Adjustment& adjustment);
Json::Value CorrelationsSection(const Adjustment& adjustment);

}  // namespace insitu
