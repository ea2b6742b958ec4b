// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "radiometry/spectrum/spectra_page.h"

namespace insitu {
namespace {

// "0.8,0.5,0.2"
Eigen::Vector3d ParseRgb(const std::string& text) {
  Eigen::Vector3d rgb;
  char end = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &rgb[0], &rgb[1], &rgb[2], &end) != 3) {
    throw InputError("--rgb", "\"" + text + "\", expected three numbers, as 0.8,0.5,0.2");
  }
  return rgb;
}

int RunSpectra(int argc, char** argv) {
  ProgramOptions program(
      "Which spectra stand behind colours, as Appendix A of Durisch 1992 finds them: basis "
      "functions,\n"
      "metamers, and the way back from spectrum to colour.",
      "insitu-spectra");
  program.Footer("Example: insitu-spectra --rgb 0.8,0.5,0.2 --page spectra.html");
  SpectraRequest request;
  std::string rgb = "0.8,0.5,0.2";
  std::filesystem::path page;
  program.Value("--rgb", &rgb, "the colour whose metamers are shown, linear, 0 to 1",
                {.shows_default = true});
  program.Value("--space", &request.space, "its RGB space",
                {.shows_default = true, .one_of = {"ntsc", "rec709", "p3", "rec2020"}});
  program.Value("--bins", &request.bins, "spectral bins: 16, or 9 as in the paper",
                {.shows_default = true, .one_of = {"9", "16"}});
  program.Value("--page", &page, "write it as a page with diagrams, FILE.html");
  return RunProgram(program, argc, argv, [&] {
    request.rgb = ParseRgb(rgb);
    const Json::Value report = SpectraReport(request);
    std::cout << BriefSpectra(report);
    if (!page.empty()) WriteSpectraPage(page, report);
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunSpectra(argc, argv); }
