// SPDX-License-Identifier: GPL-3.0-or-later
// RENDER: one photograph becomes a montage, tile by tile. [Durisch92, §6]
#pragma once

#include <functional>
#include <vector>

#include "calibration/photo/raster.h"
#include "renderer/picture/render_options.h"
#include "renderer/tiles/finished_tile.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

struct RenderResult {
  Raster linear;
  Raster layers;  // shares of each pixel: of the photograph, computed, and in front by the matte
  // One channel: how much of each pixel is of surfaces, mirrored or behind glass, that no
  // photograph shows, so that their colour is a guess.
  Raster unseen;
  long building_pixels = 0;  // some ray hits the building
  long changed_pixels = 0;   // other pixels that differ from the photograph
  // Of these, clipped ones: drawn from a reflectance that is a lower bound.
  long clipped_darkened = 0, clipped_lifted = 0;
  long unseen_pixels = 0;  // some share of which is `unseen`
  double unseen_area = 0;  // those shares' sum [px]
  double mean_rays = 0;    // a pixel
  int tiles_left = 0;      // not rendered, since it was stopped: they hold the photograph
};

// How a render is followed, stopped and taken up again.
struct RenderCourse {
  std::vector<FinishedTile> earlier = {};  // of the same render: these are not rendered again
  std::function<void(const FinishedTile&)> tile_done = {};  // called from any thread
  std::function<bool()> stops = {};  // asked before each tile, from any thread
};

// `camera` and `photo` are one view: a photograph with its lens, or an input image with the
// pinhole. Pixels that the building does not influence are those of `photo`, bit for bit. The
// result does not depend on the number of threads, nor on what was rendered earlier. Where
// something stands in front the photograph stays, and changes by what changes behind it. Tiles in
// sight of the building come first.
RenderResult RenderMontage(const MontageScene& scene, const PosedCamera& camera,
                           const Raster& photo, const RenderOptions& options = {},
                           const RenderCourse& course = {});

}  // namespace insitu
