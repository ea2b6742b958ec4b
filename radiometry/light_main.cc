// SPDX-License-Identifier: GPL-3.0-or-later
// insitu-light: haze and daylight of a reconstructed site, from its photographs.
#include <iostream>
#include <optional>
#include <string>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/program/program.h"
#include "calibration/program/warnings.h"
#include "calibration/site_responses.h"
#include "radiometry/light_page.h"
#include "radiometry/light_report.h"
#include "radiometry/measure_daylight.h"

namespace insitu {
namespace {

// From the raw files beside the photographs.
void RunResponse(const SitePaths& site) {
  const std::filesystem::path file = site.root / "work/light/response.json";
  const std::filesystem::path stated = site.photos() / "response.json";
  if (std::filesystem::exists(stated)) {
    throw InputError(stated,
                     "is there already, expected photographs whose response is not stated "
                     "yet; move it away to fit anew");
  }
  const std::vector<PhotographPair> pairs = PairsOf(site);
  if (pairs.empty()) {
    throw InputError(site.photos(),
                     "has no raw beside a picture, expected one of the same name to fit to");
  }
  const PairedResponses responses = MeasurePairedResponses(pairs);
  WriteJson(file, responses.file);
  std::cout << responses.report << "copy " << file.string() << " to " << stated.string()
            << " and run insitu-undistort and insitu-light again to measure by it\n";
}

// With all that the paper's §7 says of its examples.
LightOptions AsPrinted(LightOptions options) {
  options.as_printed = options.uniform_ambient = options.average_over_wavelength = true;
  options.bins = 9;
  options.polar_facets = 2;
  return options;
}

int RunLight(int argc, char** argv) {
  ProgramOptions program("Measures haze and daylight of a site and writes work/environment.json.",
                         "insitu-light");
  program.Footer("Example: insitu-light sites/gallery --sky-facets 8");
  SitePaths site;
  LightOptions options;
  program.Site(&site);
  std::optional<int> bins, polar_facets;
  program.Value("--bins", &bins, "spectral bins: 16, or 9 as in the paper",
                {.one_of = {"9", "16"}, .text = "9|16 [" + std::to_string(options.bins) + "]"});
  program.Value("--sky-facets", &polar_facets, "m_h: the sky has 4 m_h^2 facets",
                {.range = {{1, kMostPolarFacets}},
                 .text = "1..16 [" + std::to_string(options.polar_facets) + "]"});
  program.Flag("--average", &options.average_over_wavelength,
               "the paper's one spectrum for sun, sky and ambient light");
  program.Flag("--uniform-ambient", &options.uniform_ambient,
               "the paper's ambient light, alike everywhere, instead of photographed surroundings");
  program.Value("--bounces", &options.bounces,
                "bounces of light among surfaces; 0: sun and sky alone; without: all",
                {.check = OptionCheck::kNonNegative});
  program.Flag("--paper", &options.as_printed,
               "both inversions to the letter of the paper: ambient light alike everywhere, one "
               "spectrum, rho = 1, least squares without weights or bounds, one sun direction of "
               "0.0004 sr, Appendix A on NTSC's primaries; with --bins 9 --sky-facets 2",
               "--bounces");
  bool fit_response = false;
  program.Flag("--fit-response", &fit_response,
               "fit the camera's response, for JPEG whose curve is not sRGB's: to raw files of the "
               "same names; writes work/light/response.json alone");
  return RunProgram(program, argc, argv, [&] {
    if (fit_response) return RunResponse(site);
    if (options.as_printed) options = AsPrinted(options);
    options.bins = bins.value_or(options.bins);
    options.polar_facets = polar_facets.value_or(options.polar_facets);
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
