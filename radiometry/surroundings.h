// SPDX-License-Identifier: GPL-3.0-or-later
// Light that the surroundings send to a surface: the photographs show how bright they are, and the
// polygons where they are. What the paper's ambient term stands for, measured instead of guessed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/photograph.h"
#include "radiometry/atmosphere.h"
#include "radiometry/rgb_to_spectrum.h"
#include "reconstruction/scene_geometry.h"

namespace insitu {

struct SurfacePoint {
  Eigen::Vector3d position;  // [m], world
  Eigen::Vector3d normal;    // unit, world, towards the side that is lit
};

// Light rays start this far off a surface: survey noise leaves polygons that lie on each other
// about a centimetre apart, and the lower of two must not be shaded by the upper. [m]
constexpr double kRayOffset = 0.02;

// Irradiance at each point from all directions that do not end in the sky. A direction's radiance
// is the true colour of the polygon that it meets, from the photograph named by the polygon, else
// from the first one that shows the place. What no photograph shows counts as the mean of all that
// was seen. Empty if none of the points sees any photographed surface. `photos` go with
// scene.cameras.
std::vector<Spectrum> GatherSurroundings(const std::vector<SurfacePoint>& points,
                                         const SceneGeometry& scene,
                                         const std::vector<Photograph>& photos,
                                         const Atmosphere& air, const SpectralBasis& spectra);

}  // namespace insitu
