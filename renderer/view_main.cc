// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>

#include "calibration/program/program.h"
#include "renderer/view/stream_page.h"
#include "renderer/view/stream_view.h"
#include "renderer/view/view_server.h"

namespace insitu {
namespace {

void TellAddress(const std::string& url) {
  std::cout << "viewing page: " << url << "\nCtrl-C ends it\n" << std::flush;
}

void AddPageOptions(ProgramOptions* program, ViewOptions* options, bool* no_browser) {
  program->Value("--port", &options->port, "of 127.0.0.1; 0: any that is free",
                 {.range = {{0, 65535}}});
  program->Flag("--no-browser", no_browser, "only print the address");
}

// `insitu-view -`
int RunStream(int argc, char** argv) {
  ProgramOptions program(
      "The picture that insitu render --stream writes, as it comes out of a pipe: in the browser, "
      "or "
      "in the terminal.\nExample:\n  ssh "
      "host insitu render sites/gallery --stream | insitu view - --text",
      "insitu-view -");
  StreamViewOptions options;
  std::string dash;
  program.Value("SITE", &dash, "- is standard input", {.is_required = true});
  program.Flag("--text", &options.is_text, "a coarse picture in the terminal");
  program.Value("--columns", &options.columns, "of the terminal",
                {.shows_default = true, .range = {{1, 1000}}});
  program.Value("--snapshot", &options.snapshot, "the newest picture as a file, FILE.ppm");
  ViewOptions page;
  bool no_browser = false;
  AddPageOptions(&program, &page, &no_browser);
  return RunProgram(program, argc, argv, [&] {
    if (!options.is_text && options.snapshot.empty()) {
      page.opens_browser = !no_browser;
      const auto make = [](std::function<void(std::string)> send) {
        return MakeStreamService(&std::cin, std::move(send));
      };
      return ServePage(page, make, TellAddress);
    }
    ViewStream(options, [](const std::string& text) { std::cout << text << std::flush; });
  });
}

bool IsOfStream(int argc, char** argv) {
  return std::any_of(argv + std::min(argc, 1), argv + argc,
                     [](const char* argument) { return std::string_view(argument) == "-"; });
}

int RunView(int argc, char** argv) {
  ProgramOptions program(
      "The viewing page: photographs and montages of a site side by side in a browser, before and "
      "after, pixel by pixel, with the outline's uncertainty; renders as their tiles come.\n"
      "Example:\n  insitu view sites/gallery\nA picture out of a pipe: insitu view - --help",
      "insitu-view");
  SitePaths site;
  ViewOptions options;
  bool no_browser = false;
  program.Site(&site);
  AddPageOptions(&program, &options, &no_browser);
  return RunProgram(program, argc, argv, [&] {
    options.opens_browser = !no_browser;
    ServeView(site, options, TellAddress);
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) {
  return insitu::IsOfStream(argc, argv) ? insitu::RunStream(argc, argv)
                                        : insitu::RunView(argc, argv);
}
