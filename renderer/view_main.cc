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

void AddPageOptions(CLI::App* app, ViewOptions* options, bool* no_browser) {
  app->add_option("--port", options->port, "of 127.0.0.1; 0: any that is free")
      ->check(CLI::Range(0, 65535));
  app->add_flag("--no-browser", *no_browser, "only print the address");
}

// `insitu-view -`
int RunStream(int argc, char** argv) {
  CLI::App app(
      "The picture that insitu render --stream writes, as it comes out of a pipe: in the browser, "
      "or "
      "in the terminal.\nExample:\n  ssh "
      "host insitu render sites/gallery --stream | insitu view - --text",
      "insitu-view -");
  StreamViewOptions options;
  std::string dash;
  app.add_option("SITE", dash, "- is standard input")->required();
  app.add_flag("--text", options.is_text, "a coarse picture in the terminal");
  app.add_option("--columns", options.columns, "of the terminal")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--snapshot", options.snapshot, "the newest picture as a file, FILE.ppm");
  ViewOptions page;
  bool no_browser = false;
  AddPageOptions(&app, &page, &no_browser);
  return RunProgram(app, argc, argv, [&] {
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
  CLI::App app(
      "The viewing page: photographs and montages of a site side by side in a browser, before and "
      "after, pixel by pixel, with the outline's uncertainty; renders as their tiles come.\n"
      "Example:\n  insitu view sites/gallery\nA picture out of a pipe: insitu view - --help",
      "insitu-view");
  SitePaths site;
  ViewOptions options;
  bool no_browser = false;
  AddSite(&app, &site);
  AddPageOptions(&app, &options, &no_browser);
  return RunProgram(app, argc, argv, [&] {
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
