// SPDX-License-Identifier: GPL-3.0-or-later
// One camera of a site: made, judged and written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/boards/board_calibration.h"
#include "calibration/camera_files/camera_file.h"
#include "calibration/camera_files/film.h"
#include "calibration/lens/camera.h"
#include "calibration/program/finding.h"
#include "calibration/program/site.h"
#include "calibration/site_cameras.h"

namespace insitu {

// A scan of film as a camera.
struct FilmScan {
  FilmCamera film;
  std::vector<Fiducial> marks;
  FilmMap map;
  CameraFit fit;
};

// One camera of a site, with whichever of the four it came from.
struct CameraCalibration {
  std::string name;  // "": the only camera of the site
  Camera camera;
  std::optional<BoardCalibration> boards = {};
  std::optional<CameraFile> file = {};
  std::optional<FilmScan> scan = {};
  std::optional<double> exif_focal_px = {};
  std::optional<LensAssessment> lens = {};  // of boards, or of a brought solution of mrcal
  std::vector<std::string> photos = {};     // those of the site that this camera took
  std::vector<Finding> findings = {};
  std::string BriefReport() const;  // one line, and one a finding
};

// From a folder of boards or of a camera file. `photos` are those of the site that the camera took.
// Writes site.camera(). Throws InputError.
CameraCalibration CalibrateCamera(const SitePaths& site, const CameraFolder& folder,
                                  const std::vector<std::filesystem::path>& photos,
                                  const BoardCalibrationOptions& options);

// From a folder of scanned film: a camera for each of the `photos` that has marks there, named
// after it. Writes site.camera() of each. Throws InputError.
std::vector<CameraCalibration> CalibrateScans(const SitePaths& site, const CameraFolder& folder,
                                              const std::vector<std::filesystem::path>& photos);

// From the focal length of EXIF, which is no calibration and is said to be none. Writes
// site.camera(). Throws InputError: EXIF tells none, or other cameras of some photos.
CameraCalibration CameraFromExif(const SitePaths& site,
                                 const std::vector<std::filesystem::path>& photos);

}  // namespace insitu
