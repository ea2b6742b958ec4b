// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/site_photos.h"

#include "calibration/calibration_report.h"
#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "calibration/site_cameras.h"

namespace insitu {

SitePhotos ReadSitePhotos(const SitePaths& site) {
  SitePhotos photos;
  photos.paths = ListPhotographs(site);
  for (const std::string& camera : CamerasOfPhotos(site, photos.paths)) {
    RequireResult(site.camera(camera), "insitu-calibrate");
    photos.names.push_back(photos.paths[photos.names.size()].stem().string());
    photos.cameras.push_back(ReadCamera(site.camera(camera)));
    PhotoLens lens;
    if (!camera.empty()) lens.camera = camera;
    if (const auto covariance = ReadIntrinsicsCovariance(site, camera)) {
      lens.covariance = *covariance;
    }
    photos.lenses.push_back(lens);
    photos.site_cameras.push_back(camera);
  }
  return photos;
}

void RequireSizes(const std::vector<std::filesystem::path>& photos,
                  const std::vector<Camera>& cameras) {
  INSITU_CHECK(photos.size() == cameras.size());
  for (size_t i = 0; i < photos.size(); ++i) {
    RequirePhotographSize(photos[i], cameras[i].width(), cameras[i].height());
  }
}

}  // namespace insitu
