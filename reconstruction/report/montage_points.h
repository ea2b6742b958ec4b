// SPDX-License-Identifier: GPL-3.0-or-later
// At which points the report says what the adjustment means for the montage, before there is a
// planned building.
#pragma once

#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/geometry/scene_geometry.h"
#include "reconstruction/report/report_context.h"

namespace insitu {

// site.json's "report_points", [{"name": "ridge", "position": [x, y, z]}, ...] in world metres,
// such as corners of the planned building; without them the corners of the box around the polygons
// that are not level. Throws InputError.
std::vector<MontagePoint> MontagePoints(const SitePaths& site, const SceneGeometry& scene);

}  // namespace insitu
