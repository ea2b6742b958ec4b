// SPDX-License-Identifier: GPL-3.0-or-later
// Haze and daylight of a site, measured in its photographs: the natural environment.
#pragma once

#include <optional>
#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/program/site.h"
#include "radiometry/light_measurement.h"

namespace insitu {

// How finely the surroundings of samples are looked at.
struct SurroundingsDetail {
  int directions = 4096;       // about a sample
  double piece_m = 0.15;       // of what surrounds it, where that is nearest
  int piece_directions = 256;  // about each piece
  int rounds = 4;              // of light and unseen surroundings; each gains a digit
};

struct LightOptions {
  int bins = kMaxBins;   // 16, or 9 as the paper's mode
  int polar_facets = 8;  // m_h
  bool average_over_wavelength = false;
  // Both inversions as printed: the image function at each sample instead of a mean about it, rho =
  // 1, least squares without weights and bounds, D65 times the plain mean of k, one sun direction
  // of 0.0004 sr, Appendix A on NTSC's primaries; with uniform_ambient. [Durisch92, §4, §7]
  bool as_printed = false;
  bool uniform_ambient = false;     // Eq. (4) as printed, instead of photographed surroundings
  std::optional<int> bounces = {};  // of light among surfaces, at most; 0: sun and sky alone
  SurroundingsDetail around = {};

  void Check() const;  // throws CheckError that names the field that is wrong
};

// Horizon colour, haze (7), daylight (9) from the site's photographs and samples.
// Throws InputError.
LightMeasurement MeasureDaylight(const SitePaths& site, const LightOptions& options = {});

// The same while samples are still being chosen, from a scene and its photographs in memory:
// samples at fault are listed in `left_out`, and so are lists that are too short. Of the
// environment the input images are missing, and the brightest value. `kept` makes the next time
// faster. Throws InputError: what is left is too little, or materials.json or a matte is at fault.
LightMeasurement MeasureDaylightSoFar(const SitePaths& site, const SceneGeometry& scene,
                                      const std::vector<Photograph>& photos, KeptSkyBlocks* kept,
                                      std::vector<Sentence>* left_out);

}  // namespace insitu
