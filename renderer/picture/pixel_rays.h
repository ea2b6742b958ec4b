// SPDX-License-Identifier: GPL-3.0-or-later
// The rays of one pixel, as many as it needs. [Durisch92, §6.2]
#pragma once

#include <Eigen/Core>
#include <memory>

#include "calibration/lens/sight_map.h"
#include "calibration/photo/photograph.h"
#include "renderer/picture/render_options.h"
#include "renderer/trace/montage_scene.h"
#include "renderer/trace/sampling.h"

namespace insitu {

// One view being rendered; all of it is read only while tiles are at work.
struct ViewWork {
  const MontageScene& scene;
  const Raster& photo;
  const RenderOptions& options;
  SightMap sights;
  Eigen::Matrix3d local_from_cam;
  Eigen::Vector3d center;  // [m], local
};

// Keeps references to all but `camera`.
ViewWork PrepareView(const MontageScene& scene, const PosedCamera& camera, const Raster& photo,
                     const RenderOptions& options);

// How much of a pixel something in front covers, 0..1.
float FrontShare(const ViewWork& view, int x, int y);

// What the photograph would show without it.
Eigen::Vector3d Behind(const ViewWork& view, int x, int y);

// The line of sight of a position on the photograph; beyond its frame that of the border.
Ray SightOf(const ViewWork& view, const Eigen::Vector2d& pixel);

// The rays of one pixel, gathered.
struct PixelSum {
  int rays = 0, building_rays = 0;
  double unseen = 0;                                   // sum of the rays' shares
  Eigen::Vector3d building = Eigen::Vector3d::Zero();  // sum of the building's radiances
  Eigen::Vector3d change = Eigen::Vector3d::Zero();    // sum of the site's changes
  ColorStatistics statistics;
  std::shared_ptr<LayeredPixel> layered = {};  // sums over the rays; null: nobody asks

  bool IsChanged() const { return building_rays > 0 || !change.isZero(0); }
  Eigen::Vector3d Mean(const Eigen::Vector3d& photo_rgb) const {
    const Eigen::Vector3d site = (rays - building_rays) * photo_rgb + change;
    return (building + site) / rays;
  }
};

// Four at a time until the options' tolerance is kept. `near_outline`: the building's outline may
// spread into it.
PixelSum SamplePixel(const ViewWork& view, int x, int y, bool near_outline);

}  // namespace insitu
