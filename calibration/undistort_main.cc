// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program/program.h"
#include "calibration/program/warnings.h"
#include "calibration/site_undistortion.h"

int main(int argc, char** argv) {
  insitu::ProgramOptions program(
      "Removes the lens distortion from a site's photographs, in linear light.",
      "insitu-undistort");
  insitu::SitePaths site;
  program.Site(&site);
  program.Footer(
      "Example: insitu-undistort gallery\n"
      "writes gallery/work/input_images/*.exr and pinhole.cameramodel.");
  return insitu::RunProgram(program, argc, argv, [&] {
    const insitu::SiteUndistortion undistortion = insitu::UndistortSite(site);
    std::cout << undistortion.BriefReport() << "\n" << insitu::WarningLines(undistortion.warnings);
  });
}
