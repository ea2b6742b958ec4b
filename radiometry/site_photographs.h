// SPDX-License-Identifier: GPL-3.0-or-later
// A site's photographs as its light is measured in them.
#pragma once

#include <vector>

#include "calibration/photo/exif.h"
#include "calibration/program/site.h"
#include "radiometry/light/photographed_color.h"
#include "radiometry/measure/photo_exposures.h"
#include "radiometry/measure/photograph_set.h"
#include "radiometry/natural_environment.h"

namespace insitu {

// In the order of the scene's cameras, with what their EXIF tells of their exposure. Throws
// InputError: one is missing or not of its camera's size.
PhotographSet FindPhotographs(const SitePaths& site, const SceneGeometry& scene,
                              std::vector<ExifExposure>* exposures);

// The camera of each photograph's input image, and where that is. Throws InputError: a camera is
// missing.
std::vector<InputImage> ListInputImages(const SitePaths& site, const SceneGeometry& scene);

// The photographs, where they can all be held, else their input images, which are read in tiles and
// divided by the gain of `exposures`. Throws InputError: an input image is missing.
std::vector<LocalImage> LocalImages(const NaturalEnvironment& environment,
                                    const PhotographSet& photos,
                                    const std::vector<PhotoExposure>& exposures);

}  // namespace insitu
