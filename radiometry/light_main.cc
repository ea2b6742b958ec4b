// SPDX-License-Identifier: GPL-3.0-or-later
// insitu-light: haze and daylight of a reconstructed site, from its photographs.
#include <iostream>

#include "calibration/program/program.h"
#include "calibration/program/warnings.h"
#include "radiometry/light_page.h"
#include "radiometry/light_report.h"
#include "radiometry/measure_daylight.h"

namespace insitu {
namespace {

int RunLight(int argc, char** argv) {
  CLI::App app("Measures haze and daylight of a site and writes work/environment.json.",
               "insitu-light");
  app.footer("Example: insitu-light sites/gallery --sky-facets 8");
  SitePaths site;
  LightOptions options;
  AddSite(&app, &site);
  app.add_option("--bins", options.bins, "spectral bins: 16, or 9 as in the paper")
      ->check(CLI::IsMember({9, 16}))
      ->capture_default_str();
  app.add_option("--sky-facets", options.polar_facets, "m_h: the sky has 4 m_h^2 facets")
      ->check(CLI::Range(1, kMostPolarFacets))
      ->capture_default_str();
  app.add_flag("--average", options.average_over_wavelength,
               "the paper's one spectrum for sun, sky and ambient light");
  app.add_flag("--uniform-ambient", options.uniform_ambient,
               "the paper's ambient light, alike everywhere, instead of photographed surroundings");
  app.add_option("--bounces", options.bounces,
                 "bounces of light among surfaces; 0: sun and sky alone; without: all")
      ->check(CLI::NonNegativeNumber);
  return RunProgram(app, argc, argv, [&] {
    const LightMeasurement measurement = MeasureDaylight(site, options);
    const Json::Value report = LightPageReport(site, measurement);
    WriteEnvironment(site, measurement);
    WriteLightPage(site, report);
    std::cout << BriefReport(measurement);
    std::cout << WarningLines(TextsOf(measurement.warnings));
    std::cout << VerdictLines(site, report);
  });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunLight(argc, argv); }
