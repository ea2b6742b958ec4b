// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/program/program.h"
#include "renderer/prepare/prepare_server.h"
#include "renderer/prepare/site_of_photos.h"

namespace insitu {
namespace {

void Prepare(const SitePaths& site, const std::string& colleague, const PrepareOptions& options) {
  if (const int linked = MakeSiteOfPhotographs(site); linked > 0) {
    std::cout << linked << " photographs linked into " << site.photos().string()
              << "; the originals stay as they are\n";
  }
  if (!colleague.empty()) {
    std::cout << MergeColleague(site, {colleague});
    return;
  }
  const auto tell = [](const std::string& url) {
    std::cout << "measuring page: " << url
              << "\nCtrl-C ends it; all that the page shows as saved is "
              << "in the survey's files\n"
              << std::flush;
  };
  ServePrepare(site, options, tell,
               [](const std::string& text) { std::cerr << "warning: " + text + "\n"; });
}

int RunPrepare(int argc, char** argv) {
  ProgramOptions program(
      "The measuring page: control points, marks, polygons, sun, light, measured on the "
      "photographs in "
      "a browser, with the adjustment live. SITE may hold nothing but photographs.\nExample:\n  "
      "insitu "
      "prepare sites/gallery",
      "insitu-prepare");
  SitePaths site;
  PrepareOptions options;
  std::string colleague;
  bool no_browser = false;
  program.Site(&site);
  program.Value("--port", &options.port,
                "of 127.0.0.1; 0: the site's last one, else any that is free",
                {.range = {{0, 65535}}});
  program.Flag("--no-browser", &no_browser, "only print the address");
  program.Value("--merge", &colleague,
                "take in what a colleague measured in a copy of the site; differences are told",
                {.check = OptionCheck::kFolder});
  return RunProgram(program, argc, argv, [&] {
    options.opens_browser = !no_browser;
    Prepare(site, colleague, options);
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunPrepare(argc, argv); }
