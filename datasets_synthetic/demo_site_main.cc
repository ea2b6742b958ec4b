// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program/program.h"
#include "datasets_synthetic/demo_site.h"

int main(int argc, char** argv) {
  insitu::ProgramOptions program(
      "Makes the demo site: photographs of a small gallery on a lawn, its survey, a planned\n"
      "building, and in truth/ what the finished montages ought to show.",
      "insitu-demo-site");
  std::filesystem::path folder;
  program.Value("OUT_DIR", &folder, "the site folder to write; files of the same name are replaced",
                {.is_required = true});
  program.Footer("Example: insitu-demo-site demo");
  return insitu::RunProgram(program, argc, argv, [&] {
    insitu::Progress progress("demo site", insitu::demo::kDemoSiteSteps);
    insitu::demo::DemoSiteOptions options;
    options.step_done = [&progress] { progress.Step(); };
    std::cout << insitu::demo::MakeDemoSite(folder, options).BriefReport();
  });
}
