// SPDX-License-Identifier: GPL-3.0-or-later
// From a rough drawing to a matte: how much of each pixel something in front covers.
#pragma once

#include "calibration/photo/raster.h"

namespace insitu {

// Closed-form matting [Levin, Lischinski & Weiss 2008]: within 3 x 3 pixels the share is an affine
// function of colour, here of linear light, in which shares mix. `trimap` has one channel and the
// photograph's size: 0 is behind, 1 in front, all between is to be found; returned with that filled
// in, 0..1. By conjugate gradients, coarse to fine. What the drawing says of neither side nearby is
// found by likeness with what it does say, and half if it says nothing at all.
Raster EstimateMatte(const Raster& photo, Raster trimap);

}  // namespace insitu
