// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program/program.h"
#include "reconstruction/tie_points_site.h"

int main(int argc, char** argv) {
  insitu::SitePaths site;
  insitu::TiePointsOptions options;
  bool is_question = false;
  insitu::ProgramOptions program(
      "Finds points that several photographs of a site show, and first positions of the "
      "photographs, by COLMAP with the calibrated lens held fixed.",
      "insitu-tie-points");
  program.Site(&site);
  program.Value("--points", &options.selection.points_per_photo,
                "tie points kept on a photo at most; 0: all",
                {.shows_default = true, .check = insitu::OptionCheck::kNonNegative});
  program.Value("--exhaustive", &options.colmap.pairs.exhaustive_photos,
                "up to so many photos every pair is matched, else each with its best partners",
                {.shows_default = true, .check = insitu::OptionCheck::kNonNegative});
  program.Value("--max-size", &options.colmap.max_image_size,
                "larger photos are searched for features at this size [px]",
                {.shows_default = true, .check = insitu::OptionCheck::kPositive});
  program.Flag("--is-needed", &is_question,
               "only answer: yes if a photo shows fewer than three control points, else no");
  program.Value(
      "--model", &options.model,
      "a COLMAP model of these photos, perhaps among others, text or binary, to take instead "
      "of running COLMAP",
      {.check = insitu::OptionCheck::kFolder});
  program.Footer("Example:\n  insitu-tie-points sites/gallery --points 1000");
  return insitu::RunProgram(program, argc, argv, [&] {
    if (is_question) {
      std::cout << (insitu::NeedsTiePoints(site) ? "yes\n" : "no\n");
      return;
    }
    std::cout << insitu::MakeTiePoints(site, options).BriefReport();
  });
}
