// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <optional>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "calibration/program/program.h"
#include "calibration/program/warnings.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "renderer/hours/relight_site.h"

namespace insitu {
namespace {

struct RelightCommand {
  SitePaths site;
  HourRequest hour;
  std::optional<double> azimuth, elevation;  // [deg]
};

HourRequest RequestOf(const RelightCommand& command) {
  HourRequest request = command.hour;
  if (command.azimuth && command.elevation) {
    request.sun = SunPosition{*command.azimuth * kDegree, *command.elevation * kDegree};
  }
  if (request.time.empty() == !request.sun) {
    throw InputError("insitu-relight", "expected --hour, or --azimuth and --elevation");
  }
  return request;
}

void Relight(const RelightCommand& command) {
  const RelitSite relit = RelightSite(command.site, RequestOf(command));
  const SunPosition& sun = relit.hour.position;
  std::cout << relit.hour.name << ": " << relit.photos << " photographs relit, sun at azimuth "
            << Number("%.2f", sun.azimuth / kDegree) << " deg, elevation "
            << Number("%.2f", sun.elevation / kDegree) << " deg, aerosol depth "
            << Number("%.2f", relit.aerosol_depth) << "\n"
            << WarningLines(relit.hour.remarks);
}

int RunRelight(int argc, char** argv) {
  ProgramOptions program(
      "Simulates a site's photographs and daylight at another hour, scaled from what was measured "
      "as a cloudless sky's; never the photograph's own light.",
      "insitu-relight");
  RelightCommand command;
  program.Site(&command.site);
  program.Value(
      "--hour", &command.hour.time,
      "16:30 of the photographs' day, or 2024-12-21T12:00; the sun by the almanac, in the "
      "frame of the measured zenith and sun");
  program.Value("--azimuth", &command.azimuth, "of a chosen sun, from true north eastwards [deg]",
                {.range = {{0, 360}}});
  program.Value("--elevation", &command.elevation, "of that sun [deg]", {.range = {{3, 90}}});
  program.Footer(
      "Writes work/hours/NAME/, which insitu-render --hour NAME takes for the site's own light;\n"
      "its montages are named <photo>@NAME and say that they are a simulation.\n"
      "Example: insitu relight sites/gallery --hour 16:30");
  return RunProgram(program, argc, argv, [&] { Relight(command); });
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunRelight(argc, argv); }
