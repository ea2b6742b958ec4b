// SPDX-License-Identifier: GPL-3.0-or-later
// What a measurement of haze and daylight found, and from what.
#pragma once

#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/photo/exif.h"
#include "radiometry/measure/clipped_shares.h"
#include "radiometry/measure/fit_atmosphere.h"
#include "radiometry/measure/fit_daylight.h"
#include "radiometry/measure/photo_exposures.h"
#include "radiometry/measure/samples.h"
#include "radiometry/measure_sky.h"
#include "radiometry/natural_environment.h"

namespace insitu {

// What the light inversion found.
struct LightMeasurement {
  NaturalEnvironment environment;
  LightSamples samples;
  AtmosphereFit air_fit;  // without haze samples: clear air, residuals empty
  DaylightFit daylight_fit;
  SeenSky sky;                       // with uniform ambient light: none
  bool reflectance_known = false;    // false: rho = 1, the building's brightness is relative
  std::vector<HazeSample> haze;      // as samples.haze
  Spectrum brdf = Spectrum::Zero();  // of the daylight samples' material [1/sr]
  // What the last fit was given, as samples.daylight; and the share of each one's hemisphere that
  // no photograph shows (empty with Eq. (4)'s ambient light, which asks for nothing around).
  std::vector<DaylightSample> daylight;
  std::vector<double> unseen;
  bool is_simplified = false;         // an option leaves out the light from around, or evens it
  bool as_printed = false;            // the paper's inversions, LightOptions::as_printed
  std::vector<ClippedShare> clipped;  // empty: not looked at, or nothing is
  double brightest = 0;               // value in any photograph
  // Photographs whose codes count as light by the curve of their colour space alone: pictures that
  // a camera or a program rendered, without a response.
  std::vector<std::string> assumed_response;
  std::vector<ExifExposure> exposures;  // as the scene's cameras; empty: not read
  // By which all photographs were brought to one unit, as the scene's cameras; empty: they were
  // not.
  ExposureFit exposure_fit;
  std::vector<Sentence> warnings;
};

}  // namespace insitu
