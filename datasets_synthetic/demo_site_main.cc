// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iostream>
#include <string>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "datasets_synthetic/demo_site.h"
#include "datasets_synthetic/examples.h"

namespace insitu::demo {
namespace {

struct Command {
  std::filesystem::path folder;
  std::string example;
  int width = 0;
};

void MakeExample(const Command& command) {
  const auto& names = ExampleNames();
  if (std::find(names.begin(), names.end(), command.example) == names.end()) {
    throw InputError("--example", "there is no \"" + command.example +
                                      "\", expected gallery, bridge or courtyard");
  }
  const int width = command.width > 0 ? command.width : 720;
  const SiteDescription example = DescribeExample(command.example, width, width * 2 / 3);
  Progress progress(command.example, SiteSteps(example.site));
  SiteOptions options;
  options.with_boards = false;
  options.is_example = true;
  options.step_done = [&progress] { progress.Step(); };
  std::cout << WriteSite(command.folder, example, options).BriefReport();
}

void MakeDemo(const Command& command) {
  Progress progress("demo site", kDemoSiteSteps);
  SiteOptions options;
  options.step_done = [&progress] { progress.Step(); };
  std::cout << MakeDemoSite(command.folder, options).BriefReport();
}

}  // namespace
}  // namespace insitu::demo

int main(int argc, char** argv) {
  insitu::ProgramOptions program(
      "Makes the demo site: photographs of a small gallery on a lawn, its survey, a planned\n"
      "building, and in truth/ what the finished montages ought to show. Or one of the paper's\n"
      "three examples, with a camera file instead of photographs of a board.",
      "insitu-demo-site");
  insitu::demo::Command command;
  program.Value("OUT_DIR", &command.folder,
                "the site folder to write; files of the same name are replaced",
                {.is_required = true});
  program.Value("--example", &command.example, "gallery, bridge or courtyard");
  program.Value("--width", &command.width, "of an example's photographs [px], else 720");
  program.Footer("Example: insitu-demo-site --example gallery gallery");
  return insitu::RunProgram(program, argc, argv, [&] {
    command.example.empty() ? MakeDemo(command) : MakeExample(command);
  });
}
