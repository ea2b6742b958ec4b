// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the survey's polygons are what the model takes them for: planar, with simple outlines.
#pragma once

#include <map>
#include <string>

#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Throws InputError at a polygon with a vertex further from the best-fit plane than the larger of
// 20 plane_sigma and 0.1 m, plus ten sigma of its least certain vertex. Vertices of infinite sigma
// are not judged.
void RequirePlanar(const Survey& survey, const std::map<std::string, StartPoint>& points,
                   double plane_sigma);

// Throws InputError at a polygon whose outline crosses itself or has no area.
void RequireSimpleOutlines(const Survey& survey, const std::map<std::string, StartPoint>& points);

}  // namespace insitu
