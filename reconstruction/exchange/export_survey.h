// SPDX-License-Identifier: GPL-3.0-or-later
// A site's control points and marks as other programs read them, so that anyone can check us.
// Results for COLMAP: colmap_export.h.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct SurveyExport {
  std::vector<std::filesystem::path> written;
  std::vector<std::string> report;  // what the format cannot hold, in words
};

// For DBAT: script.xml and the tables control.txt, check.txt, marks.txt, images.txt, cameras.xml,
// in DBAT's pixels; points have running numbers, their names are labels. The script resects,
// intersects and adjusts with the cameras fixed, as we do. Each lens is the backward Brown one
// nearest to that of `cameras`, which go with `photographs`; the report says how near.
// `photographs` are the files, by their name in the survey. Throws InputError: a lens that no Brown
// camera fits, no marks.
SurveyExport ExportDbat(const Survey& survey, const std::vector<Camera>& cameras,
                        const std::vector<std::filesystem::path>& photographs,
                        const std::filesystem::path& folder);

// For OpenDroneMap and OpenSfM: gcp_list.txt under `crs`, which ODM needs. It has no place for
// sigmas; check points and points without coordinates stay out. Throws InputError: an unknown
// system, no marks of control points.
SurveyExport ExportOdm(const Survey& survey, const std::vector<std::filesystem::path>& photographs,
                       const std::string& crs, const std::filesystem::path& folder);

}  // namespace insitu
