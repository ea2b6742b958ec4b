// SPDX-License-Identifier: GPL-3.0-or-later
// The true colour of natural surfaces, looked up in the photographs. [Durisch92, §6.2 case D]
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "renderer/light_split.h"
#include "renderer/montage_scene.h"

namespace insitu {

struct PhotographedColor {
  Spectrum true_color;        // L_0 >= 0, haze removed by [Durisch92, Eq. (8)]
  Eigen::Vector3d to_camera;  // unit, towards the photograph it was seen from
};

// Looks up a point of a polygon in the photo of its image attribute or, where that does not show
// it (out of frame, hidden, other side), in the first other photo that does. nullopt: none does.
std::optional<PhotographedColor> LookUpColor(const MontageScene& scene, int polygon,
                                             const SurfacePoint& surface);

// For each polygon the mean of rho, [Durisch92, Eq. (10)], over all photographed polygons of its
// material, or of the whole site where its material is nowhere photographed.
std::vector<Spectrum> MeanBrdfOfPolygons(const MontageScene& scene);

}  // namespace insitu
