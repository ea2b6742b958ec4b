// SPDX-License-Identifier: GPL-3.0-or-later
// The natural environment description: cameras, polygons, air and light. [Durisch92, §5]
#pragma once

#include <json/value.h>

#include <map>
#include <string>

#include "calibration/program/site.h"
#include "radiometry/light/atmosphere.h"
#include "radiometry/light/daylight.h"
#include "radiometry/light/material.h"
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

// What work/environment.json holds of it. Numbers come back to the same bits from a file of 17
// digits; whoever writes the file may add what is not read, such as standard deviations.
Json::Value DescriptionOf(const NaturalEnvironment& environment);

// From work/environment.json, which alone describes the environment. Throws InputError.
NaturalEnvironment ReadEnvironment(const SitePaths& site);

}  // namespace insitu
