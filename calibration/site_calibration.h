// SPDX-License-Identifier: GPL-3.0-or-later
// The two stages of this folder on a site: its camera, and its input images.
#pragma once

#include <optional>
#include <string>

#include "calibration/board.h"
#include "calibration/camera.h"
#include "calibration/site.h"

namespace insitu {

struct SiteCalibration {
  Camera camera;
  std::optional<BoardCalibration> boards;  // nullopt: the site brought its camera
  std::string BriefReport() const;
};

// Takes calibration/camera.cameramodel as it is, else calibrates from calibration/board_* and
// board.txt. Writes site.camera() and site.calibration_report(). Throws InputError.
SiteCalibration CalibrateSite(const SitePaths& site, const BoardCalibrationOptions& options = {});

struct SiteUndistortion {
  Camera pinhole;
  int photos = 0;
  std::string BriefReport() const;
};

// Every photograph becomes an input image [Durisch92, §4.1]: site.input_image() as linear EXR, seen
// by site.pinhole_camera(). Throws InputError: no calibration yet, a photograph of another size
// than the camera's; nothing is written then.
SiteUndistortion UndistortSite(const SitePaths& site);

}  // namespace insitu
