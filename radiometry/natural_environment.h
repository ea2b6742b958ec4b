// SPDX-License-Identifier: GPL-3.0-or-later
// The natural environment description: cameras, polygons, air and light. [Durisch92, §5]
#pragma once

#include <map>
#include <string>

#include "calibration/photograph.h"
#include "radiometry/atmosphere.h"
#include "radiometry/daylight.h"
#include "radiometry/fit_atmosphere.h"
#include "radiometry/fit_daylight.h"
#include "radiometry/material.h"
#include "radiometry/rgb_to_spectrum.h"
#include "reconstruction/scene_geometry.h"

namespace insitu {

struct NaturalEnvironment {
  SceneGeometry scene;
  SpectralBasis spectra;
  Atmosphere air;
  Daylight light;
  std::map<std::string, NaturalMaterial> materials;  // every polygon's material has an entry
};

struct LightOptions {
  int bins = kMaxBins;               // 16, or 9 as the paper's mode
  int polar_facets = 8;              // m_h
  bool average_over_wavelength = false;
};

// What the light inversion found, for the report and the environment file.
struct LightMeasurement {
  NaturalEnvironment environment;
  AtmosphereFit air_fit;       // rms < 0 never; zero samples: clear air
  DaylightFit daylight_fit;
  bool reflectance_known = false;  // false: rho = 1, the building's brightness is relative
  std::vector<std::string> warnings;
  std::string BriefReport() const;
};

// Horizon colour, haze (7), daylight (9) from the site's photographs and samples.
// Throws InputError.
LightMeasurement MeasureDaylight(const SitePaths& site, const LightOptions& options = {});

// work/environment.json; polygons and cameras are those of scene.json, repeated in full so that
// the file alone describes the environment. Reading throws InputError.
void WriteEnvironment(const SitePaths& site, const LightMeasurement& measurement);
NaturalEnvironment ReadEnvironment(const SitePaths& site);

}  // namespace insitu
