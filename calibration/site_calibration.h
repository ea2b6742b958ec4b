// SPDX-License-Identifier: GPL-3.0-or-later
// The two stages of this folder on a site: its cameras, and its input images.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/boards/board_calibration.h"
#include "calibration/camera_files/camera_file.h"
#include "calibration/camera_files/film.h"
#include "calibration/lens/camera.h"
#include "calibration/program/finding.h"
#include "calibration/program/site.h"

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

// Covariance of a calibrated camera's intrinsics, in the order of Camera::intrinsics(), from its
// report; nullopt: it brought none (splined models, scans, most camera files).
std::optional<Eigen::MatrixXd> ReadIntrinsicsCovariance(const SitePaths& site,
                                                        const std::string& camera);

struct SiteUndistortion {
  std::vector<Camera> pinholes;  // one a camera
  int photos = 0;
  std::string BriefReport() const;
};

// Every photograph becomes an input image [Durisch92, §4.1]: site.input_image() as linear EXR, seen
// by its camera's site.pinhole_camera(). Throws InputError: no calibration yet, a photograph of
// another size than its camera's; nothing is written then.
SiteUndistortion UndistortSite(const SitePaths& site);

}  // namespace insitu
