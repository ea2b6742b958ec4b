// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program/program.h"
#include "reconstruction/tie_points_site.h"

int main(int argc, char** argv) {
  insitu::SitePaths site;
  insitu::TiePointsOptions options;
  bool is_question = false;
  CLI::App app(
      "Finds points that several photographs of a site show, and first positions of the "
      "photographs, by COLMAP with the calibrated lens held fixed.",
      "insitu-tie-points");
  insitu::AddSite(&app, &site);
  app.add_option("--points", options.selection.points_per_photo,
                 "tie points kept on a photo at most; 0: all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--exhaustive", options.colmap.pairs.exhaustive_photos,
                 "up to so many photos every pair is matched, else each with its best partners")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--max-size", options.colmap.max_image_size,
                 "larger photos are searched for features at this size [px]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--is-needed", is_question,
               "only answer: yes if a photo shows fewer than three control points, else no");
  app.add_option(
         "--model", options.model,
         "a COLMAP model of these photos, text or binary, to take instead of running COLMAP")
      ->check(CLI::ExistingDirectory);
  app.footer("Example:\n  insitu-tie-points sites/gallery --points 1000");
  return insitu::RunProgram(app, argc, argv, [&] {
    if (is_question) {
      std::cout << (insitu::NeedsTiePoints(site) ? "yes\n" : "no\n");
      return;
    }
    std::cout << insitu::MakeTiePoints(site, options).BriefReport();
  });
}
