// SPDX-License-Identifier: GPL-3.0-or-later
// Both environments made ready for rays.
#pragma once

#include <vector>

#include "calibration/photo/raster.h"
#include "radiometry/natural_environment.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// `artificial` may be empty: the site as it is. `images` are those of natural.input_images.
MontageScene MakeMontageScene(NaturalEnvironment natural, const ArtificialEnvironment& artificial,
                              std::vector<Raster> images);

// The same in two steps, so that images can be read while the first is done; mean_brdf_of_polygon,
// for which every image is read, stays empty (mean_brdf.h).
MontageScene SceneWithoutImages(NaturalEnvironment natural,
                                const ArtificialEnvironment& artificial);
void SetInputImages(std::vector<Raster> images, MontageScene* scene);
// Images that are not in memory: scene->input_images stays empty.
void SetInputImages(const std::vector<LocalImage::ImageFunction>& images, MontageScene* scene);

// What a pixel in the middle of the sharpest input image spans [rad].
double PixelAngle(const NaturalEnvironment& natural);

// What a planned material is to rays, but for its textures.
SpectralMaterial SpectralMaterialOf(const SpectralBasis& spectra, const SurfaceMaterial& material);

}  // namespace insitu
