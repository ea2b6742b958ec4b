// SPDX-License-Identifier: GPL-3.0-or-later
// insitu-calibrate on a site: its cameras.
#pragma once

#include <string>
#include <vector>

#include "calibration/boards/board_calibration.h"
#include "calibration/camera_calibration.h"
#include "calibration/program/site.h"

namespace insitu {

struct SiteCalibration {
  std::vector<CameraCalibration> cameras;  // sorted by name
  int outdated_lenses = 0;                 // that adjustments from earlier calibrations found
  std::string BriefReport() const;
};

// Calibrates each of ListCameraFolders(site): takes a camera file, else solves from board_* photos
// and board.txt, or ties scans to their film. Without any of these the focal length of EXIF is
// taken, and said to be no calibration. Writes site.camera(), calibration_report() and
// calibration_page() of each, and removes its site.adjusted_camera(). Throws InputError.
SiteCalibration CalibrateSite(const SitePaths& site, const BoardCalibrationOptions& options = {});

}  // namespace insitu
