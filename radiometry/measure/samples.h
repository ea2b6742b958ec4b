// SPDX-License-Identifier: GPL-3.0-or-later
// survey/samples.json: pixels chosen on the photographs for horizon colour, haze and daylight.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/sentence.h"
#include "calibration/program/site.h"
#include "radiometry/measure/photograph_set.h"
#include "radiometry/spectrum/spectral_table.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

struct PixelSample {
  int photo = 0;               // index into SceneGeometry::cameras
  Eigen::Vector2d pixel;       // of the original photograph
  std::optional<int> polygon;  // nullopt: sky (horizon samples)
  Eigen::Vector3d rgb;         // mean linear colour about the pixel
  Eigen::Vector3d rgb_sigma;   // of that mean, > 0
  double unevenness = 0;       // standard deviation of the pixels about it, over their mean
  Eigen::Vector3d point;       // [m], world, on the polygon; zero for sky
  double distance = 0;         // [m] from the camera; zero for sky
  FilePlace place;
};

struct SampleOptions {
  // [px], the colour is the mean over (2 radius + 1)^2 pixels of the same surface; 0: the image
  // function at the sample itself, as [Durisch92, §4.2] has it.
  int radius = 2;

  void Check() const;  // throws CheckError that names the field that is wrong
};

struct LightSamples {
  std::vector<PixelSample> horizon, haze, daylight;
  // Of the daylight samples' material: as a colour, linear Rec. 709, 0..1, or as that of an entry
  // of the library, > 0; at most one of them.
  std::optional<Eigen::Vector3d> daylight_reflectance;
  std::optional<SpectralTable> reflectance_table;
  std::optional<SpectralTable> daylight_spectrum;  // the paper's L, relative; nullopt: D65
};

// Throws InputError that names every fault with its line: unknown photo or polygon, outside the
// frame, clipped, a polygon sample whose sight misses its polygon or meets another one before it, a
// horizon sample on a polygon, haze samples that are fewer than two, daylight samples fewer than
// three. samples.json may lack "haze" (air stays clear) but not "horizon" or "daylight". It may
// state "daylight_reflectance_rgb" or, by the library's names, "daylight_material", and
// "daylight_spectrum". With `faults`, for samples that are still being chosen, the samples at fault
// are left out and listed there instead, and there may be any number of the others.
LightSamples ReadSamples(const SitePaths& site, const SceneGeometry& scene,
                         const PhotographSet& photos, const SampleOptions& options = {},
                         std::vector<Sentence>* faults = nullptr);

}  // namespace insitu
