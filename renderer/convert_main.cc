// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <string>

#include "calibration/program/program.h"
#include "renderer/convert.h"
#include "renderer/convert_report.h"

namespace insitu {
namespace {

int RunConvert(int argc, char** argv) {
  CLI::App app(
      "Reads the planned building: the models in building/ (DXF, IFC, OBJ, glTF, COLLADA, "
      "PLY,\n"
      "STL), placement.json, materials.json and lights.json.\n"
      "Writes work/building.json and work/building.bin.",
      "insitu-convert");
  app.footer(
      "Examples:\n"
      "  insitu-convert my_site --preview\n"
      "  insitu-convert my_site --list > my_site/building/materials.json");
  SitePaths site;
  ConvertOptions options;
  std::string report;
  bool list = false, preview = false;
  AddSite(&app, &site);
  app.add_option("--model", options.models, "read this model instead of those in building/")
      ->check(CLI::ExistingFile)
      ->take_all();
  app.add_option("--chord-tolerance", options.import.dxf.chord_tolerance,
                 "how far a facet may be from its arc [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--report", report, "write what was read and left out as JSON");
  app.add_flag("--preview", preview, "write work/building_preview.png and .html");
  app.add_flag("--list", list, "print a materials.json with every name found, and write nothing");
  return RunProgram(app, argc, argv, [&] {
    if (list) {
      std::cout << MaterialsTemplate(site, options);
      return;
    }
    const Conversion conversion = ConvertBuilding(site, options);
    if (!report.empty()) WriteConvertReport(report, conversion);
    if (preview) WritePreview(site.root / "work/building_preview", conversion);
    RequireSurface(site, conversion);
    WriteArtificialEnvironment(site, conversion.environment);
    std::cout << conversion.BriefReport();
    for (const std::string& line : NotShown(conversion.environment)) {
      std::cout << "not shown: " << line << "\n";
    }
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunConvert(argc, argv); }
