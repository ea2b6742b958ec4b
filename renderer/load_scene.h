// SPDX-License-Identifier: GPL-3.0-or-later
// A site and its building, read and made ready for rays.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/photo/raster.h"
#include "calibration/program/site.h"
#include "radiometry/natural_environment.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// Linear, as photographed. Throws InputError: not there, or not of its camera's size.
Raster ReadInputImage(const InputImage& image);

// With the building's textures and the input images in the site's unit: whole, or, where they are
// over 0.8 GB together, as functions that read what they are asked for and give the same to the
// last bit. `gains`: of the scene's cameras. Throws InputError as ReadInputImage does.
MontageScene LoadScene(const SitePaths& site, NaturalEnvironment natural,
                       const std::vector<Eigen::Vector3d>& gains,
                       const ArtificialEnvironment& building);

}  // namespace insitu
