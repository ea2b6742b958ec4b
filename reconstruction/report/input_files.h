// SPDX-License-Identifier: GPL-3.0-or-later
// Which files a reconstruction was made from, so that another party can tell that theirs are the
// same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/report/report_context.h"

namespace insitu {

// The survey's files, site.json, tie points, these cameras with the reports of their calibration,
// and the photographs, as far as they exist, by name. Cameras are named as in SitePaths.
std::vector<InputFile> HashInputs(const SitePaths& site, const std::vector<std::string>& cameras);

// The outline within which mrcal says that a .cameramodel is valid [px], its
// `valid_intrinsics_region`; empty if the file tells none.
std::vector<Eigen::Vector2d> ReadCalibratedRegion(const std::filesystem::path& camera);

}  // namespace insitu
