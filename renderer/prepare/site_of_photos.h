// SPDX-License-Identifier: GPL-3.0-or-later
// The photographs of a site to measure, and what insitu-prepare does besides serving its page.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

std::vector<std::string> PhotoNames(const SitePaths& site);

// Width and height [px] by name; photographs that cannot be read have none.
std::map<std::string, Eigen::Vector2i> PhotoSizes(const SitePaths& site);

// A folder that holds nothing but photographs becomes a site: photos/ with links to them (copies
// where the file system has no links). How many; 0: it is a site already. Throws InputError:
// neither.
int MakeSiteOfPhotographs(const SitePaths& site);

// Rows of a colleague's folder of the same site that are new come in; what differs stays ours, is
// told, and waits for the page, where it is decided. Throws InputError: a measuring page is open on
// the site, or it cannot be written.
std::string MergeColleague(const SitePaths& site, const SitePaths& colleague);

}  // namespace insitu
