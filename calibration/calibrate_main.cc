// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program.h"
#include "calibration/site_calibration.h"

int main(int argc, char** argv) {
  CLI::App app(
      "Finds the interior orientation of a site's camera from photographs of a chessboard,\n"
      "or takes the one that the site brings.",
      "insitu-calibrate");
  insitu::SitePaths site;
  insitu::BoardCalibrationOptions options;
  app.add_option("SITE", site.root, "the site folder")->required();
  app.add_option("--lens-model", options.lens_model, "a lens model of mrcal")
      ->capture_default_str();
  app.add_option("--focal-px", options.focal_px,
                 "focal length to start from [px]; else from EXIF, else a 50 degree field of view")
      ->check(CLI::Range(1.0, 1e6));
  app.footer(
      "Example: insitu-calibrate gallery\n"
      "writes gallery/work/calibration/camera.cameramodel and report.json.");
  return insitu::RunProgram(app, argc, argv, [&] {
    std::cout << insitu::CalibrateSite(site, options).BriefReport() << "\n";
  });
}
