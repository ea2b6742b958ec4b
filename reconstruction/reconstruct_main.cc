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
  insitu::ProgramOptions program(
      "Finds where the photographs of a site were taken from, its polygons, and the directions to "
      "the sun and the zenith, in one adjustment of its survey.",
      "insitu-reconstruct");
  program.Site(&site);
  program.Value("--plane-sigma", &options.plane_sigma, "vertex off its polygon's plane [m]",
                {.shows_default = true, .check = insitu::OptionCheck::kPositive});
  program.Value("--zenith-sigma", &options.zenith_sigma, "top off the plumb line of bottom [m]",
                {.shows_default = true, .check = insitu::OptionCheck::kPositive});
  program.Value("--sun-sigma", &options.sun_sigma, "shadow point off the sun's ray [m]",
                {.shows_default = true, .check = insitu::OptionCheck::kPositive});
  program.Flag("--hard-planes", &options.has_hard_planes,
               "hold vertices on their planes all but exactly, whatever --plane-sigma says");
  program.Flag("--self-calibrate", &options.is_self_calibrating,
               "adjust the lens parameters too, from the calibration's values");
  program.Value("--significance", &options.significance,
                "probability that the test of a good observation fails",
                {.shows_default = true, .range = {{1e-6, 0.5}}});
  program.Value("--start", &start_poses,
                "estimated positions, JSON: {\"PHOTO\": {\"center\": [x,y,z], \"look_at\": "
                "[x,y,z]}}",
                {.check = insitu::OptionCheck::kFile});
  program.Value("--colmap-model", &colmap_model,
                "folder to receive the result as a COLMAP text model as well");
  program.Footer("Example:\n  insitu-reconstruct sites/gallery --plane-sigma 0.01");
  return insitu::RunProgram(program, argc, argv, [&] {
    // Before what may fail for want of them.
    std::cerr << insitu::WarningLines(insitu::UnreadFiles(site));
    const insitu::Adjustment adjustment =
        insitu::ReconstructSite(site, options, start_poses, program.CommandLine());
    if (!colmap_model.empty()) {
      insitu::WriteColmapText(colmap_model, insitu::ColmapFromAdjustment(adjustment));
    }
    std::cout << "verdict: "
              << insitu::ReadJson(site.residual_report())["verdict"]["status"].asString() << " ("
              << site.residual_page().string() << ")\n"
              << adjustment.BriefReport();
  });
}
