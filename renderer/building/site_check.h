// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a building can stand where its coordinates put it.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// Where the site is: the box about its polygons (work/reconstruction/scene.json), before there are
// any about its control points; empty: neither is there.
Eigen::AlignedBox3d SiteBox(const SitePaths& site);

// What is suspicious, a sentence each: a building far from the site, or one whose size or place
// would be right if its unit were another (mm, cm, m, inches, feet) than `metres_per_unit`, that of
// its file; nullopt: it names none and was taken as metres, and is suspicious if it is larger than
// the site. `site` may be empty: then only sizes that no building has are named.
std::vector<std::string> SuspicionsOf(const Eigen::AlignedBox3d& building,
                                      const Eigen::AlignedBox3d& site,
                                      std::optional<double> metres_per_unit);

}  // namespace insitu
