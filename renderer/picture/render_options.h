// SPDX-License-Identifier: GPL-3.0-or-later
// How one photograph is rendered, and what a pixel of it is made of.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "calibration/photo/foreground.h"
#include "calibration/photo/raster.h"
#include "radiometry/light/image_quality.h"
#include "renderer/trace/light_split.h"

namespace insitu {

// Of a pixel, means over its rays.
struct LayeredPixel {
  LayeredPixel() { light.fill(Eigen::Vector3d::Zero()); }
  bool is_computed = false;  // else the photograph's own, whatever the rays brought
  double seen = 1;           // share that nothing in front covers
  double coverage = 0;       // of the rays that met the building
  std::array<Eigen::Vector3d, kLightParts> light;       // linear RGB
  Eigen::Vector3d grain = Eigen::Vector3d::Zero();      // noise added
  Eigen::Vector3d ray_error = Eigen::Vector3d::Zero();  // of the mean, a standard deviation
  double distance = 0;                                  // mean over the rays that met something [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();     // sum over them, unit if there are any
  std::map<int, double> polygons, materials;            // shares of the rays: site's, building's
};

struct RenderOptions {
  int fewest_rays = 4;       // a pixel, a multiple of 4
  int most_rays = 16;        // a pixel, a multiple of 4
  double tolerance = 0.004;  // standard error of a pixel in sRGB units (1 = white) that is enough
  double reach = 0.5;        // change in 8-bit sRGB codes up to which the photograph's pixel stays
  int block = 1;             // side of squares that one set of rays stands for [px]: 1, 2 or 4
  int threads = 0;           // 0: as many as there are cores
  // How the photograph spreads a point: what is computed is spread alike. nullopt: each pixel is
  // the mean over its square.
  std::optional<PointSpread> point_spread = {};
  int outline_rays = 32;  // with a point spread: a pixel that the outline may spread into, at most
  std::optional<Grain> grain = {};  // noise that computed pixels get; nullopt: none
  std::shared_ptr<const Foreground> foreground = {};  // of this photograph; null: nothing in front
  // Whether the photograph shows less than there was: its sensor clipped. Empty: nowhere.
  std::function<bool(int x, int y)> is_clipped = {};
  // One channel of the photograph's size: of the sun that no polygon keeps away, what it shows to
  // arrive, 0..1; null: all.
  std::shared_ptr<const Raster> sun_share = {};
  // Told what each pixel of a tile that is rendered is made of, from any thread; empty: nobody
  // asks.
  std::function<void(int x, int y, const LayeredPixel&)> layers = {};

  void Check() const;  // throws CheckError that names the field that is wrong
};

}  // namespace insitu
