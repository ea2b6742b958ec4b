// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program/program.h"
#include "calibration/program/unread_files.h"
#include "calibration/program/warnings.h"
#include "calibration/site_calibration.h"
#include "calibration/site_cameras.h"

int main(int argc, char** argv) {
  insitu::ProgramOptions program(
      "Finds the interior orientation of a site's cameras: from photographs of a chessboard, from\n"
      "another program's camera file, or from the fiducial marks of scanned film.",
      "insitu-calibrate");
  insitu::SitePaths site;
  insitu::BoardCalibrationOptions options;
  program.Site(&site);
  const auto is_model = [](const std::string& name) {
    return name.starts_with("LENSMODEL_") ? "" : "expected a model of mrcal, as LENSMODEL_OPENCV8";
  };
  program.Value("--lens-model", &options.lens_model, "a lens model of mrcal",
                {.shows_default = true, .fault = is_model});
  program.Value("--focal-px", &options.focal_px,
                "focal length to start from [px]; else from EXIF, else a 50 degree field of view",
                {.range = {{1.0, 1e6}}});
  bool is_list = false;
  program.Flag("--list", &is_list, "only print the camera files that it would write, one a line");
  program.Footer(
      "Example: insitu-calibrate gallery\n"
      "writes gallery/work/calibration/camera.cameramodel, report.json and report.html;\n"
      "of several cameras, in calibration/CAMERA/, to gallery/work/calibration/CAMERA/.");
  return insitu::RunProgram(program, argc, argv, [&] {
    if (is_list) {
      for (const std::string& camera : insitu::CamerasOf(insitu::ListCameraFolders(site))) {
        std::cout << site.camera(camera).string() << "\n";
      }
      return;
    }
    // Before what may fail for want of them.
    std::cerr << insitu::WarningLines(insitu::UnreadFiles(site));
    const insitu::SiteCalibration calibration = insitu::CalibrateSite(site, options);
    std::cout << calibration.BriefReport() << "\n";
    for (const insitu::CameraCalibration& camera : calibration.cameras) {
      if (camera.exif_focal_px) std::cerr << "warning: " << camera.findings.front().reason << "\n";
    }
  });
}
