// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in front of the building though no polygon stands for it: trees, cars, people.
#pragma once

#include "calibration/photo/raster.h"

namespace insitu {

// A pixel of the photograph is P = m F + (1 - m) B; behind what stands in front (F), the montage
// replaces B alone.
struct Foreground {
  Raster share;   // m, one channel: 1 where nothing of what is behind is seen
  Raster behind;  // B, linear RGB; where m is 0 or 1 the photograph itself
};

// Estimates B where m is between 0 and 1, after Germer et al., "Fast Multi-Level Foreground
// Estimation" (2020). `share` has one channel and the photograph's size. 0 <= B and 0 <= F hold.
Foreground SeparateForeground(const Raster& photo, Raster share);

}  // namespace insitu
