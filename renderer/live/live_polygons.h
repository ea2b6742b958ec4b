// SPDX-License-Identifier: GPL-3.0-or-later
// The known polygons as a wireframe over the photographs.
#pragma once

#include <json/value.h>

#include <optional>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/geometry/scene_geometry.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Index of the polygon that a pixel sees first; of several that lie on each other, as a path on a
// lawn, the smallest. nullopt: none.
std::optional<size_t> PolygonSeenAt(const std::vector<Polygon>& polygons, const PosedCamera& camera,
                                    const Eigen::Vector2d& pixel);

// {NAME: {planarity_mm, area_m2, off_vertical_deg|null, images: {PHOTO: [[[x, y]...]...]}, hidden}}
// of the polygons of `survey`, the part that `solved` is of. `hidden`, shaped as `images`, has the
// parts of the outline and of holes that another polygon stands before.
Json::Value ImagedPolygons(const Survey& survey, const SolvedSurvey& solved,
                           const std::vector<PosedCamera>& cameras);

}  // namespace insitu
