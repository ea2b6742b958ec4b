// SPDX-License-Identifier: GPL-3.0-or-later
// What the light samples chosen so far say: the message `light` to the page.
#pragma once

#include <json/value.h>

#include <memory>
#include <string>
#include <vector>

#include "calibration/photo/photograph.h"
#include "calibration/program/site.h"
#include "radiometry/measure_sky.h"
#include "radiometry/natural_environment.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

// The site's photographs in linear light, each read once, when it is first asked for.
class LinearPhotos {
 public:
  explicit LinearPhotos(const SitePaths& site);
  ~LinearPhotos();

  // As scene.cameras. Throws InputError: a photograph is not there, cannot be read or is of another
  // size than its camera's.
  const std::vector<Photograph>& Of(const SceneGeometry& scene);

  KeptSkyBlocks sky_blocks;  // of these

 private:
  SitePaths site_;
  std::vector<std::string> names_;
  std::vector<Photograph> photos_;
};

// Both inversions on survey/samples.json as it stands, in the adjusted scene. {failed, haze,
// daylight, samples: {haze: [{photo, x, y, residual}], daylight: [...]}, left_out: [text], advice:
// [text]}; `failed` says what is missing, else null. Null without any sample. Throws nothing.
// `environment`, if given, receives what was measured, null where it failed.
Json::Value LiveLight(const SitePaths& site, const SceneGeometry& scene, LinearPhotos& photos,
                      std::shared_ptr<const NaturalEnvironment>* environment = nullptr);

}  // namespace insitu
