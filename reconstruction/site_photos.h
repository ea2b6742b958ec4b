// SPDX-License-Identifier: GPL-3.0-or-later
// A site's photographs with what their calibration tells of their lenses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/lens/photo_lens.h"
#include "calibration/program/site.h"

namespace insitu {

// By photograph, sorted by name.
struct SitePhotos {
  std::vector<std::filesystem::path> paths;
  std::vector<std::string> names;  // stems
  std::vector<Camera> cameras;
  std::vector<PhotoLens> lenses;
  std::vector<std::string> site_cameras;  // their cameras as SitePaths takes them
};

// Throws InputError: no photographs, a photo whose camera is unknown or not calibrated yet.
SitePhotos ReadSitePhotos(const SitePaths& site);

// Throws InputError: a photograph of another size than its camera's, or that cannot be read.
void RequireSizes(const std::vector<std::filesystem::path>& photos,
                  const std::vector<Camera>& cameras);

}  // namespace insitu
