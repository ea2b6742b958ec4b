// SPDX-License-Identifier: GPL-3.0-or-later
// insitu-convert SITE: the architect's model becomes the artificial environment description.
#include <iostream>

#include "calibration/program.h"
#include "renderer/convert.h"

namespace insitu {
namespace {

int RunConvert(int argc, char** argv) {
  CLI::App app(
      "Reads the planned building: building/*.dxf, materials.json and lights.json.\n"
      "Writes work/building.json and work/building.bin.",
      "insitu-convert");
  app.footer("Example:\n  insitu-convert my_site");
  SitePaths site;
  app.add_option("site", site.root, "the site folder")->required()->check(CLI::ExistingDirectory);
  return RunProgram(app, argc, argv, [&] {
    const Conversion conversion = ConvertBuilding(site);
    WriteArtificialEnvironment(site, conversion.environment);
    std::cout << conversion.BriefReport();
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunConvert(argc, argv); }
