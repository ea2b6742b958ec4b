// SPDX-License-Identifier: GPL-3.0-or-later
// Shadows of things that no polygon stands for, told in a photograph by brightness and colour.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/photo/raster.h"

namespace insitu {

// A pixel of a surface that the sun reaches unless something stands there that is not modelled.
struct SunPixel {
  int surface = -1;  // pixels of one number are of one material; -1: not to be judged
  Eigen::Vector3f lit =
      Eigen::Vector3f::Zero();  // ln of colour over light, if the sun reaches it, of each channel
  Eigen::Vector3f fall =
      Eigen::Vector3f::Zero();  // ln of light without the sun over light with it, below 0
};

// One channel each, of the photograph's size.
struct SunShares {
  Raster share;  // of the sun that arrives, 0..1; 1 where it cannot be judged
  Raster sigma;  // its standard deviation; 0 where it was not judged
};

// Of each surface, whose colour is unknown: colours are scattered about a mean that lit and shaded
// pixels share, with all light and without the sun's; what fits neither is neither, and a third
// class. Their means, covariance and shares by expectation maximisation; then each pixel by its own
// colour and its neighbours on the surface, the less the more they differ from it (mean field of a
// Potts model). A surface of few pixels, or on which the sun makes little difference, is taken as
// lit. `pixels` row by row.
SunShares SeparateShadows(int width, int height, const std::vector<SunPixel>& pixels);

}  // namespace insitu
