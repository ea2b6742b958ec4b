// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/site_photos.h"

#include <algorithm>

#include "calibration/calibration_report.h"
#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/site_cameras.h"

namespace insitu {
namespace {

constexpr double kMostUnequal = 1.1;  // of fx and fy: pixels are square, scans nearly
constexpr double kShortestFocal = 0.05, kLongestFocal = 60;  // of the picture's longer side

// A calibration that went wrong is no lens.
void RequireReasonable(const std::filesystem::path& path, const Camera& camera) {
  const double fx = camera.intrinsics()[0], fy = camera.intrinsics()[1];
  const double side = std::max(camera.width(), camera.height());
  const double ratio = std::max(fx, fy) / std::min(fx, fy);
  if (!(ratio <= kMostUnequal)) {
    throw InputError(
        path,
        Formatted(
            "its focal lengths fx %.0f and fy %.0f px differ by %.0f %%, expected nearly equal "
            "ones as of any lens on square pixels: calibrate it again",
            fx, fy, 100 * (ratio - 1)));
  }
  if (!(fx >= kShortestFocal * side && fx <= kLongestFocal * side)) {
    throw InputError(
        path,
        Formatted("its focal length of %.0f px is that of no lens for pictures of %d x %d px: "
                  "calibrate it again",
                  fx, camera.width(), camera.height()));
  }
}

}  // namespace

SitePhotos ReadSitePhotos(const SitePaths& site) {
  SitePhotos photos;
  photos.paths = ListPhotographs(site);
  for (const std::string& camera : CamerasOfPhotos(site, photos.paths)) {
    RequireResult(site.camera(camera), "insitu-calibrate");
    photos.names.push_back(photos.paths[photos.names.size()].stem().string());
    photos.cameras.push_back(ReadCamera(site.camera(camera)));
    RequireReasonable(site.camera(camera), photos.cameras.back());
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
