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
  ProgramOptions program("Measures haze and daylight of a site and writes work/environment.json.",
                         "insitu-light");
  program.Footer("Example: insitu-light sites/gallery --sky-facets 8");
  SitePaths site;
  LightOptions options;
  program.Site(&site);
  program.Value("--bins", &options.bins, "spectral bins: 16, or 9 as in the paper",
                {.shows_default = true, .one_of = {"9", "16"}});
  program.Value("--sky-facets", &options.polar_facets, "m_h: the sky has 4 m_h^2 facets",
                {.shows_default = true, .range = {{1, kMostPolarFacets}}});
  program.Flag("--average", &options.average_over_wavelength,
               "the paper's one spectrum for sun, sky and ambient light");
  program.Flag("--uniform-ambient", &options.uniform_ambient,
               "the paper's ambient light, alike everywhere, instead of photographed surroundings");
  program.Value("--bounces", &options.bounces,
                "bounces of light among surfaces; 0: sun and sky alone; without: all",
                {.check = OptionCheck::kNonNegative});
  return RunProgram(program, argc, argv, [&] {
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
