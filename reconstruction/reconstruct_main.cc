// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/files/json_file.h"
#include "calibration/program/program.h"
#include "calibration/program/unread_files.h"
#include "calibration/program/warnings.h"
#include "reconstruction/colmap/colmap_text.h"
#include "reconstruction/colmap_export.h"
#include "reconstruction/reconstruct_site.h"

int main(int argc, char** argv) {
  insitu::SitePaths site;
  insitu::AdjustmentOptions options;
  std::filesystem::path start_poses, colmap_model;
  CLI::App app(
      "Finds where the photographs of a site were taken from, its polygons, and the directions to "
      "the sun and the zenith, in one adjustment of its survey.",
      "insitu-reconstruct");
  insitu::AddSite(&app, &site);
  app.add_option("--plane-sigma", options.plane_sigma, "vertex off its polygon's plane [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--zenith-sigma", options.zenith_sigma, "top off the plumb line of bottom [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--sun-sigma", options.sun_sigma, "shadow point off the sun's ray [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--hard-planes", options.has_hard_planes,
               "hold vertices on their planes all but exactly, whatever --plane-sigma says");
  app.add_flag("--self-calibrate", options.is_self_calibrating,
               "adjust the lens parameters too, from the calibration's values");
  app.add_option("--significance", options.significance,
                 "probability that the test of a good observation fails")
      ->check(CLI::Range(1e-6, 0.5))
      ->capture_default_str();
  app.add_option("--start", start_poses,
                 "estimated positions, JSON: {\"PHOTO\": {\"center\": [x,y,z], \"look_at\": "
                 "[x,y,z]}}")
      ->check(CLI::ExistingFile);
  app.add_option("--colmap-model", colmap_model,
                 "folder to receive the result as a COLMAP text model as well");
  app.footer("Example:\n  insitu-reconstruct sites/gallery --plane-sigma 0.01");
  return insitu::RunProgram(app, argc, argv, [&] {
    // Before what may fail for want of them.
    std::cerr << insitu::WarningLines(insitu::UnreadFiles(site));
    const insitu::Adjustment adjustment =
        insitu::ReconstructSite(site, options, start_poses, insitu::CommandLine(app));
    if (!colmap_model.empty()) {
      insitu::WriteColmapText(colmap_model, insitu::ColmapFromAdjustment(adjustment));
    }
    std::cout << "verdict: "
              << insitu::ReadJson(site.residual_report())["verdict"]["status"].asString() << " ("
              << site.residual_page().string() << ")\n"
              << adjustment.BriefReport();
  });
}
