// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_calibration.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

#include "calibration/calibration_report.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/site_cameras.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

// The photographs of each camera.
std::map<std::string, std::vector<fs::path>> PhotosByCamera(const SitePaths& site,
                                                            const std::vector<fs::path>& photos) {
  const std::vector<std::string> cameras = CamerasOfPhotos(site, photos);
  std::map<std::string, std::vector<fs::path>> photos_of_camera;
  for (size_t i = 0; i < photos.size(); ++i) photos_of_camera[cameras[i]].push_back(photos[i]);
  return photos_of_camera;
}

void WriteReport(const SitePaths& site, const CameraCalibration& camera) {
  const Json::Value report = CalibrationReport(camera);
  WriteJson(site.calibration_report(camera.name), report);
  WriteWhole(site.calibration_page(camera.name), CalibrationPage(report));
}

}  // namespace

SiteCalibration CalibrateSite(const SitePaths& site, const BoardCalibrationOptions& options) {
  options.Check();
  const std::vector<CameraFolder> folders = ListCameraFolders(site);
  const bool has_photos = fs::is_directory(site.photos());
  const std::vector<fs::path> photos = has_photos ? ListPhotographs(site) : std::vector<fs::path>();
  auto photos_of_camera = PhotosByCamera(site, photos);
  SiteCalibration calibration;
  for (const CameraFolder& folder : folders) {
    const std::vector<fs::path>& own = photos_of_camera[folder.name];
    if (folder.source != CameraSource::kFilm) {
      calibration.cameras.push_back(CalibrateCamera(site, folder, own, options));
      continue;
    }
    std::ranges::move(CalibrateScans(site, folder, photos),
                      std::back_inserter(calibration.cameras));
  }
  if (folders.empty()) calibration.cameras.push_back(CameraFromExif(site, photos));
  for (CameraCalibration& camera : calibration.cameras) {
    for (const fs::path& photo : photos_of_camera[camera.name]) {
      camera.photos.push_back(photo.stem().string());
    }
    WriteReport(site, camera);
    calibration.outdated_lenses += fs::remove(site.adjusted_camera(camera.name)) ? 1 : 0;
  }
  return calibration;
}

std::string SiteCalibration::BriefReport() const {
  std::string text;
  for (const CameraCalibration& camera : cameras) {
    if (!text.empty()) text += "\n";
    text += camera.BriefReport();
  }
  if (outdated_lenses > 0) {
    text +=
        "\nThe lens that an earlier insitu-reconstruct --self-calibrate found is removed, "
        "since it started from another calibration: run insitu-reconstruct again.";
  }
  return text;
}

}  // namespace insitu
