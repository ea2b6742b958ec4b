// SPDX-License-Identifier: GPL-3.0-or-later
// insitu-undistort on a site: its input images.
#pragma once

#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/program/site.h"

namespace insitu {

struct SiteUndistortion {
  std::vector<Camera> pinholes;  // one a camera
  int photos = 0;
  std::vector<std::string> warnings;  // colours that had to be assumed, by photograph
  std::string BriefReport() const;
};

// Every photograph becomes an input image [Durisch92, §4.1]: site.input_image() as linear EXR, seen
// by its camera's site.pinhole_camera(). Throws InputError: no calibration yet, a photograph of
// another size than its camera's; nothing is written then.
SiteUndistortion UndistortSite(const SitePaths& site);

}  // namespace insitu
