// SPDX-License-Identifier: GPL-3.0-or-later
// A lens of mrcal's as a backward Brown camera, for programs that know no other.
#pragma once

#include <optional>

#include "calibration/lens/camera.h"
#include "calibration/lens/metric_camera.h"

namespace insitu {

struct BrownFit {
  MetricCamera lens;  // of origin_px (-0.5, -0.5), square pixels, no skew
  double rms_px = 0;  // between the corrected pixel and the sight, over the whole frame
  double largest_px = 0;
};

// Least squares of c xp yp K1 K2 K3 P1 P2 aspect over a grid of pixels. mrcal's lenses have no
// millimetres: `sensor_height_mm` sets their scale. Sights 80 degrees off the axis or more are left
// out. nullopt: too few are left, or no convergence.
std::optional<BrownFit> FitBrown(const Camera& camera, double sensor_height_mm = 24);

}  // namespace insitu
