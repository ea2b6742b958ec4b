// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/program.h"
#include "renderer/materials/material_page.h"
#include "renderer/materials/material_proposals.h"

namespace insitu {
namespace {

int RunMaterials(int argc, char** argv) {
  ProgramOptions program(
      "The material library: lists its materials and lamps, which building/materials.json,\n"
      "lights.json and survey/samples.json name. An entry is a readable file; those of the\n"
      "folders SITE/library and ~/.local/share/insitu/library go before the installed ones.",
      "insitu-materials");
  program.Footer(
      "Examples:\n"
      "  insitu-materials\n"
      "  insitu-materials my_site --page my_site/work/materials\n"
      "  insitu-materials --list my_site/building/house.ifc > proposed.json");
  SitePaths site;
  std::filesystem::path stem;
  std::vector<std::filesystem::path> models;
  program.Value("SITE", &site.root, "a site, whose entries and whose light are shown too",
                {.check = OptionCheck::kFolder});
  program.Value("--page", &stem,
                "write FILE.html and FILE.png: every material on a sphere and a wall under D65\n"
                "and, with SITE, under its sun and sky (of insitu light)");
  program.Value("--list", &models,
                "print a materials.json with the entries that the names in this model may mean;\n"
                "none counts before you write \"use\" in the place of \"proposed\"",
                {.takes_all = true, .check = OptionCheck::kFile});
  return RunProgram(program, argc, argv, [&] {
    const bool has_site = !site.root.empty();
    const MaterialLibrary library(LibraryFolders(has_site ? std::optional(site) : std::nullopt));
    if (!models.empty()) {
      std::cout << ProposedMaterials(models, library);
    } else if (!stem.empty()) {
      std::optional<NaturalEnvironment> light;
      if (has_site) light = ReadEnvironment(site);
      if (stem.extension() == ".html") stem.replace_extension();
      WriteMaterialPage(stem, library, light);
    } else {
      std::cout << MaterialList(library);
    }
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunMaterials(argc, argv); }
