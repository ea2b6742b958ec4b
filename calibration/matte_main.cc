// SPDX-License-Identifier: GPL-3.0-or-later
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "calibration/program/program.h"
#include "calibration/site_mattes.h"

namespace insitu {
namespace {

int RunMatte(int argc, char** argv) {
  ProgramOptions program(
      "Finds how much of each pixel a tree, a car, a person in front of the building covers.\n"
      "Draw it roughly over the photograph, as survey/trimaps/<photo>.png: white where nothing\n"
      "but it is seen, black where nothing of it is, and grey a broad band along its leaves.",
      "insitu-matte");
  program.Footer(
      "Example: insitu-matte path/to/site --photo IMG_2102\n"
      "Writes survey/foreground/<photo>.png, which insitu-render reads; look at it, and paint\n"
      "over what is wrong.");
  SitePaths site;
  std::vector<std::string> photos;
  bool replace = false;
  program.Site(&site);
  program.Value("--photo", &photos, "only this photograph (may be repeated)");
  program.Flag("--replace", &replace, "write over mattes that are there already");
  return RunProgram(program, argc, argv, [&] {
    for (const MadeMatte& made : MakeMattes(site, photos, replace)) {
      std::cout << made.file.string() << ": " << std::fixed << std::setprecision(1)
                << 100 * made.open << " % of the picture was to be found, " << 100 * made.fraction
                << " % of it lies in part in front\n";
    }
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunMatte(argc, argv); }
