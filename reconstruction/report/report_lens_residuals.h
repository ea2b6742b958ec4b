// SPDX-License-Identifier: GPL-3.0-or-later
// What of the residuals repeats in every photo of a camera.
// The keys of the JSON are the report's format.
#pragma once

#include <json/value.h>

#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/verdict/image_marks.h"

namespace insitu {

Json::Value LensResidualsSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks);
// Mean residual vectors of cells of about a `cells`th of the longer side.
Json::Value ResidualGrid(const std::vector<ImageMark>& marks, int width, int height, int cells);

}  // namespace insitu
