// SPDX-License-Identifier: GPL-3.0-or-later
// Where photographs show the sky, and how bright it is there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/photo/photograph.h"
#include "radiometry/measure/samples.h"
#include "reconstruction/geometry/ray_scene.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

// The mean over a block of pixels.
struct SkyPlace {
  Eigen::Vector3d direction;  // unit, world
  Eigen::Vector3d rgb;        // linear, each channel above zero
};

// Blocks of one photograph that hang together and pass smoothly into each other.
struct SkyRegion {
  int photo = 0;           // index into SceneGeometry::cameras
  bool is_marked = false;  // holds a horizon sample: sky for certain
  std::vector<SkyPlace> places;
};

// Regions of a photograph that may be sky: above the horizon, a block away from every polygon, not
// clipped, even, outside `matte` (what stands in front, one channel; null: nothing does). Trees and
// other things that no polygon stands for are uneven or regions of their own. `rays` is of
// MeshOfPolygons(scene).
std::vector<SkyRegion> SkyRegionsIn(const Photograph& photo, int index, const SceneGeometry& scene,
                                    const RayScene& rays, const Raster* matte,
                                    const std::vector<PixelSample>& horizon);

// The marked regions, and one after the other those that have the colour of the nearest place so
// far, the more loosely the farther off it is: sky in other photographs.
std::vector<SkyRegion> SkyAmong(std::vector<SkyRegion> regions);

}  // namespace insitu
