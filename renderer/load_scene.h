// SPDX-License-Identifier: GPL-3.0-or-later
// A site and its building, read and made ready for rays.
#pragma once

#include <Eigen/Core>
#include <future>
#include <variant>
#include <vector>

#include "calibration/photo/raster.h"
#include "calibration/program/site.h"
#include "radiometry/natural_environment.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// Linear, as photographed. Throws InputError: not there, or not of its camera's size.
Raster ReadInputImage(const InputImage& image);

// The input images in the site's unit: whole, or as functions that read what they are asked for and
// give the same to the last bit.
using SceneImages = std::variant<std::vector<Raster>, std::vector<LocalImage::ImageFunction>>;

// Read by a thread of its own, while the scene is made; where they are over 0.8 GB together in
// tiles, as they are asked for. `gains`: of the scene's cameras. `is_quick`: each whole when it is
// first asked for, as a quick look of one photograph needs few of the others. Its get() throws
// InputError as ReadInputImage does.
std::future<SceneImages> ReadSceneImages(const std::vector<InputImage>& images,
                                         const std::vector<Eigen::Vector3d>& gains, bool is_quick);

// With the building's textures.
MontageScene LoadScene(const SitePaths& site, NaturalEnvironment natural,
                       std::future<SceneImages> images, const ArtificialEnvironment& building);

}  // namespace insitu
