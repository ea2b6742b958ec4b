// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program/program.h"
#include "reconstruction/new_site.h"

int main(int argc, char** argv) {
  insitu::SitePaths site;
  std::filesystem::path photographs;
  insitu::ProgramOptions program(
      "Begins a site: writes the files that a person fills in, each with a word on what belongs "
      "into it, from a folder of photographs. What is there already stays.",
      "insitu-new");
  program.Value("SITE", &site.root, "the site's folder, which is made where it is missing",
                {.is_required = true});
  program.Value("--photos", &photographs, "folder of photographs to copy into the site",
                {.check = insitu::OptionCheck::kFolder});
  program.Footer("Example:\n  insitu-new sites/mill --photos ~/Pictures/mill");
  return insitu::RunProgram(program, argc, argv, [&] {
    const insitu::NewSite made = insitu::MakeNewSite(site, photographs);
    for (const std::string& file : made.written) std::cout << "wrote " << file << "\n";
    for (const std::string& remark : made.remarks) std::cout << remark << "\n";
  });
}
