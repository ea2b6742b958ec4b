// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs of the demo site by direct light alone: sun, sky and one bounce in glass. There is no
// interreflection, as in the paper's model of natural surfaces [Durisch92, Eq. (6)].
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/photo/raster.h"
#include "datasets_synthetic/campus.h"
#include "datasets_synthetic/ray_cast.h"
#include "datasets_synthetic/spectral_light.h"

namespace insitu::demo {

inline constexpr double kSunDiameter = 0.53 * 3.14159265358979 / 180;  // [rad]

// What one picture needs. The building may be empty.
struct Place {
  const Campus* campus;
  Scene building;
  Daylight daylight;
};

// Two numbers that depend on whether the building stands.
struct BeforeAfter {
  double before = 0, after = 0;
};

// The cosine-weighted visible share of the sky hemisphere over a surface, 0..1: 1 on open level
// ground. `strata` x `strata` directions, jittered by `seed`. Below the horizon all is dark.
BeforeAfter VisibleSky(const Place& place, const Eigen::Vector3d& point,
                       const Eigen::Vector3d& normal, int strata, uint64_t seed);

// The visible share of the sun's disc, 0..1, 0 on surfaces turned away.
BeforeAfter VisibleSun(const Place& place, const Eigen::Vector3d& point,
                       const Eigen::Vector3d& normal, uint64_t seed);

// What a pixel shows before the building stands.
struct PixelRecord {
  const Face* face = nullptr;  // nullptr: sky, or more than one face
  bool sky = false;
  bool plain = false;  // neither pane nor target
  float sun = 0;       // visible share of the disc
  float sky_share = 0;
  float distance = 0;  // [m]
};

struct RenderedView {
  Raster before, after;  // linear Rec. 709, in the frame of the photograph, distortion and all
  Raster mask;           // one channel, code / 255: 0 untouched, 170 other light, 255 building
  std::vector<PixelRecord> records;  // row-major
};

struct RenderOptions {
  int sky_strata = 12;  // squared: directions to the sky for each 2 x 2 pixels of a face
};

// 2 x 2 samples a pixel. Independent of the number of threads.
RenderedView RenderView(const Place& place, const View& view, const RenderOptions& options = {});

}  // namespace insitu::demo
