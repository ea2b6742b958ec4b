// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <iostream>
#include <string>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "renderer/building/shown_environment.h"
#include "renderer/convert.h"
#include "renderer/convert_report.h"
#include "renderer/formats/temporary_folder.h"
#include "renderer/materials_template.h"

namespace insitu {
namespace {

struct ConvertCommand {
  std::filesystem::path input;   // a site folder, or a model
  std::filesystem::path output;  // of a model: its description; empty: none is written
  std::string variant;           // of a site
  std::string report;
  bool list = false, preview = false;
  ConvertOptions options;
};

void Write(const ConvertCommand& command, const SitePaths& site, const Conversion& conversion,
           const std::filesystem::path& preview) {
  if (!command.report.empty()) WriteConvertReport(command.report, conversion);
  if (command.preview) WritePreview(preview, conversion);
  RequireSurface(site, conversion);
  std::cout << conversion.BriefReport();
  for (const std::string& line : NotShown(conversion.environment)) {
    std::cout << "not shown: " << line << "\n";
  }
}

void ConvertSite(const ConvertCommand& command) {
  const SitePaths site{command.input, command.variant};
  RequireVariant(site);
  if (!command.output.empty()) throw InputError(command.input, "is a site: -o is of a model alone");
  if (command.list) {
    std::cout << MaterialsTemplate(site, command.options);
    return;
  }
  const Conversion conversion = ConvertBuilding(site, command.options);
  Write(command, site, conversion, site.design() / "building_preview");
  WriteArtificialEnvironment(site, conversion.environment);
}

// Without a site: no materials.json, placement or lamps; images inside the model go beside the
// output, or nowhere.
void ConvertModel(ConvertCommand command) {
  if (!command.variant.empty()) {
    throw InputError(command.input, "is a model alone: --variant is of a site");
  }
  const TemporaryFolder folder;
  const bool kept = !command.output.empty();
  const SitePaths site{kept ? std::filesystem::absolute(command.output).parent_path()
                            : folder.path()};
  command.options.models = {command.input};
  if (command.list) {
    std::cout << MaterialsTemplate(site, command.options);
    return;
  }
  const Conversion conversion = ConvertBuilding(site, command.options);
  std::filesystem::path stem = kept ? command.output : command.input.filename();
  stem.replace_extension();
  stem += "_preview";
  Write(command, site, conversion, stem);
  if (kept) WriteArtificialEnvironmentFile(command.output, conversion.environment);
}

int RunConvert(int argc, char** argv) {
  ProgramOptions program(
      "Reads the planned building: the models in building/ (DXF, IFC, OBJ, glTF, COLLADA, "
      "PLY,\n"
      "STL), placement.json, materials.json and lights.json.\n"
      "Writes work/building.json and work/building.bin. Of a model alone, without a site, what -o "
      "says.",
      "insitu-convert");
  program.Footer(
      "Examples:\n"
      "  insitu-convert my_site --preview\n"
      "  insitu-convert my_site --list > my_site/building/materials.json\n"
      "  insitu-convert house.ifc --preview");
  ConvertCommand command;
  program.Value("SITE", &command.input, "site folder, or a model's file",
                {.is_required = true, .check = OptionCheck::kPath});
  program.Value("--variant", &command.variant,
                "of a site, the design in variants/VARIANT; to work/variants/VARIANT");
  program.Value("-o,--output", &command.output, "write a model alone as FILE.json and FILE.bin");
  program.Value("--model", &command.options.models, "read this model instead of those in building/",
                {.takes_all = true, .check = OptionCheck::kFile});
  program.Value("--chord-tolerance", &command.options.import.dxf.chord_tolerance,
                "how far a facet may be from its arc [m]",
                {.shows_default = true, .check = OptionCheck::kPositive});
  program.Value("--report", &command.report, "write what was read and left out as JSON");
  program.Flag("--preview", &command.preview,
               "write work/building_preview.png and .html, of a model MODEL_preview.png and .html: "
               "the building to be turned");
  program.Flag("--list", &command.list,
               "print a materials.json with every name found, and write nothing");
  return RunProgram(program, argc, argv, [&] {
    if (std::filesystem::is_directory(command.input)) {
      ConvertSite(command);
    } else {
      ConvertModel(command);
    }
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunConvert(argc, argv); }
