// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a building can stand where its coordinates put it.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// Where the site is: the box about its polygons (work/reconstruction/scene.json), before there are
// any about its control points; empty: neither is there.
Eigen::AlignedBox3d SiteBox(const SitePaths& site);

// What is suspicious, a sentence each: a building far from the site, or one whose size or place
// would be right if its unit were another (factors 10, 12, 25.4, 39.37, 100, 304.8, 1000 and their
// inverses). `site` may be empty: then only sizes that no building has are named. Of files that
// name no unit, which are taken as metres, only units so mistaken are thought of.
std::vector<std::string> SuspicionsOf(const Eigen::AlignedBox3d& building,
                                      const Eigen::AlignedBox3d& site, bool names_unit = true);

}  // namespace insitu
