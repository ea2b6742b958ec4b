// SPDX-License-Identifier: GPL-3.0-or-later
// A site's photographs for the live solution, whatever of their calibration is there yet.
#pragma once

#include <optional>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/live/live_solution.h"

namespace insitu {

// As ReadSitePhotos, but a photo without a calibrated camera has none instead of throwing. Throws
// InputError: no photographs.
std::vector<LivePhoto> ReadLivePhotos(const SitePaths& site);

// nullopt: site.json is not there or lacks latitude, longitude or true_north.
std::optional<LiveSite> ReadLiveSite(const SitePaths& site);

}  // namespace insitu
