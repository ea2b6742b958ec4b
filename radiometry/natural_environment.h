// SPDX-License-Identifier: GPL-3.0-or-later
// The natural environment description: cameras, polygons, air and light. [Durisch92, §5]
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibration/photo/photograph.h"
#include "radiometry/light/atmosphere.h"
#include "radiometry/light/daylight.h"
#include "radiometry/light/material.h"
#include "radiometry/measure/fit_atmosphere.h"
#include "radiometry/measure/fit_daylight.h"
#include "radiometry/measure/samples.h"
#include "radiometry/spectrum/rgb_to_spectrum.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

struct NaturalEnvironment {
  SceneGeometry scene;
  SpectralBasis spectra;
  Atmosphere air;
  Daylight light;
  std::map<std::string, NaturalMaterial> materials;  // every polygon's material has an entry
};

struct LightOptions {
  int bins = kMaxBins;   // 16, or 9 as the paper's mode
  int polar_facets = 8;  // m_h
  bool average_over_wavelength = false;
  bool uniform_ambient =
      false;  // Eq. (4) in the inversion too, instead of photographed surroundings
};

// What the light inversion found, for the report and the environment file.
struct LightMeasurement {
  NaturalEnvironment environment;
  LightSamples samples;
  AtmosphereFit air_fit;  // without haze samples: clear air, residuals empty
  DaylightFit daylight_fit;
  bool reflectance_known = false;  // false: rho = 1, the building's brightness is relative
  std::vector<std::string> warnings;
  Eigen::Vector3d TransmittanceRgb(double distance) const;  // of white light over a distance [m]
  Eigen::Vector3d SunIrradianceRgb() const;                 // across the sun's rays: k_s L Omega_s
  // What the open sky sends: k_h L + k_u L, for Eq. (4) spreads the ambient light over the sky too.
  // Comparable with a measured sky; k_h L alone is what a shaded facet loses.
  Eigen::Vector3d OpenSkyRgb() const;
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
