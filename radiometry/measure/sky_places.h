// SPDX-License-Identifier: GPL-3.0-or-later
// Where photographs show the sky, and how bright it is there.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/lens/camera.h"
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

// A photograph in square blocks, row by row: what of it may be sky, wherever it was taken from.
struct SkyBlocks {
  int size = 0, columns = 0, rows = 0;  // size [px]; what is left over at the edges is in none
  // Mean colour of those that are not clipped, even and outside the matte.
  std::vector<std::optional<Eigen::Vector3d>> colors;
  std::vector<Eigen::Vector3d> corners, middles;  // unit, camera axes; (columns + 1)(rows + 1), all
};

// `matte`: what stands in front, one channel; null: nothing does.
SkyBlocks SkyBlocksOf(const Photograph& photo, const Camera& camera, const Raster* matte);

// Regions of the blocks of scene.cameras[index] that may be sky: above the horizon, a block away
// from every polygon. Trees and other things that no polygon stands for are uneven or regions of
// their own. `rays` is of MeshOfPolygons(scene).
std::vector<SkyRegion> SkyRegionsIn(const SkyBlocks& blocks, int index, const SceneGeometry& scene,
                                    const RayScene& rays, const std::vector<PixelSample>& horizon);

// The marked regions, and one after the other those that have the colour of the nearest place so
// far, the more loosely the farther off it is: sky in other photographs.
std::vector<SkyRegion> SkyAmong(std::vector<SkyRegion> regions);

}  // namespace insitu
