// SPDX-License-Identifier: GPL-3.0-or-later
// The residual report: JSON is the source, the self-contained page is made from it alone. It holds
// no dates, host names or folders: the same input gives the same bytes.
#pragma once

#include <json/value.h>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/report/report_context.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

Json::Value ResidualReport(const Adjustment& adjustment, const Survey& survey,
                           const ReportContext& context = ReportContext());

}  // namespace insitu
