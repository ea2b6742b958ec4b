// SPDX-License-Identifier: GPL-3.0-or-later
// The known polygons as a wireframe over the photographs.
#pragma once

#include <json/value.h>

#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/geometry/scene_geometry.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

double AreaOf(const Polygon& polygon);  // [m^2]

// {NAME: {planarity_mm, area_m2, off_vertical_deg|null, images: {PHOTO: [[[x, y]...]...]}, hidden}}
// of the polygons of `survey`, the part that `solved` is of. `hidden`, shaped as `images`, has the
// parts of the outline that another polygon stands before.
Json::Value ImagedPolygons(const Survey& survey, const SolvedSurvey& solved,
                           const std::vector<PosedCamera>& cameras);

}  // namespace insitu
