// SPDX-License-Identifier: GPL-3.0-or-later
// The known polygons as a wireframe over the photographs.
#pragma once

#include <json/value.h>

#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// {NAME: {planarity_mm, area_m2, off_vertical_deg|null, images: {PHOTO: [[[x, y]...]...]}}} of the
// polygons of `survey`, the part that `solved` is of.
Json::Value ImagedPolygons(const Survey& survey, const SolvedSurvey& solved,
                           const std::vector<PosedCamera>& cameras);

}  // namespace insitu
