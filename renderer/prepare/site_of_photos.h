// SPDX-License-Identifier: GPL-3.0-or-later
// What insitu-prepare does besides serving its page.
#pragma once

#include <string>

#include "calibration/program/site.h"

namespace insitu {

// A folder that holds nothing but photographs becomes a site: photos/ with links to them (copies
// where the file system has no links). How many; 0: it is a site already. Throws InputError:
// neither.
int MakeSiteOfPhotographs(const SitePaths& site);

// Rows of a colleague's folder of the same site that are new come in; what differs stays ours and
// is told. Throws InputError: a measuring page is open on the site, or it cannot be written.
std::string MergeColleague(const SitePaths& site, const SitePaths& colleague);

}  // namespace insitu
