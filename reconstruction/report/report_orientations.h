// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras and photos in the report: interior and exterior orientations.
// The keys of the JSON are the report's format.
#pragma once

#include <json/value.h>

#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/report/large_report.h"
#include "reconstruction/report/report_context.h"
#include "reconstruction/verdict/image_marks.h"

namespace insitu {

Json::Value CamerasSection(const Adjustment& adjustment, const ReportContext& context);
Json::Value PhotosSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks,
                          const ReportContext& context, const ReportExtent& extent);

}  // namespace insitu
