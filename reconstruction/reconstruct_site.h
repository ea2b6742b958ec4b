// SPDX-License-Identifier: GPL-3.0-or-later
// The whole stage on a site folder: survey files in; posed cameras, scene and residual report out.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "calibration/lens/rigid3.h"
#include "calibration/program/site.h"
#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/adjustment/adjustment_options.h"

namespace insitu {

// A user's estimates: {"PHOTO": {"center": [x, y, z], "look_at": [x, y, z]}, ...}, world [m], the
// camera held upright. Throws InputError; every name must be among `photos`.
std::map<std::string, Rigid3> ReadStartPoses(const std::filesystem::path& path,
                                             const std::vector<std::string>& photos);

// Reads site.camera(), the photographs' names and the survey, adjusts, and writes site.scene(), the
// posed cameras beside it, the residual report in both forms, and as CSV all observations and
// points. `start_poses` may be empty; `command` is how the report says that it was made. Throws
// InputError; then nothing is written.
Adjustment ReconstructSite(const SitePaths& site, const AdjustmentOptions& options = {},
                           const std::filesystem::path& start_poses = {},
                           const std::string& command = "");

}  // namespace insitu
