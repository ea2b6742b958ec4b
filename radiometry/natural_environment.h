// SPDX-License-Identifier: GPL-3.0-or-later
// The natural environment description: cameras, polygons, air and light. [Durisch92, §5]
#pragma once

#include <json/value.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/program/site.h"
#include "radiometry/light/atmosphere.h"
#include "radiometry/light/daylight.h"
#include "radiometry/light/image_quality.h"
#include "radiometry/light/material.h"
#include "radiometry/spectrum/rgb_to_spectrum.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

// A photograph without its lens's distortion, in linear light. [Durisch92, §4.1]
struct InputImage {
  std::filesystem::path file;
  Camera camera;  // the pinhole that sees it, posed as its photograph
};

struct NaturalEnvironment {
  SceneGeometry scene;
  std::vector<InputImage> input_images;  // as scene.cameras
  std::vector<ImageQuality> qualities;   // as scene.cameras; empty: none was measured
  SpectralBasis spectra;
  Atmosphere air;
  Daylight light;
  std::map<std::string, NaturalMaterial> materials;  // every polygon's material has an entry
};

// The bins in use.
Json::Value BinsJson(const Spectrum& spectrum, const SpectralBins& bins);

// What `file` (work/environment.json) is to hold of it; input images are named relative to its
// folder. Numbers come back to the same bits from a file of 17 digits; whoever writes the file may
// add what is not read, such as standard deviations.
Json::Value DescriptionOf(const NaturalEnvironment& environment, const std::filesystem::path& file);

// From work/environment.json, which with the input images is all that a renderer needs to know.
// Throws InputError: not there, of another version, not as it was written.
NaturalEnvironment ReadEnvironment(const SitePaths& site);

}  // namespace insitu
