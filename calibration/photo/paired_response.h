// SPDX-License-Identifier: GPL-3.0-or-later
// A camera's response as its raw and its own picture of the same moment show it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "calibration/color/response.h"
#include "calibration/photo/raster.h"

namespace insitu {

// Where the raw has what the picture has, by the picture's pixels from the middle of its frame:
//   raw = middle + shift + scale (1 + radial r^2) pixel,   r = 1 at the picture's corner.
struct PairRegistration {
  double scale = 1;                                 // pixels of the raw a pixel of the picture
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  // [px] of the raw
  double radial = 0;                                // the camera's own correction of its lens
  double residual_px = 0;                           // RMS, of the raw; of the pieces that count
  int pieces = 0;                                   // of the frame that it was told by
};

// Pieces of the picture are looked for in the raw by phase correlation, coarse to fine. `pieces` is
// 0 where too few have enough in them.
PairRegistration RegisterPair(const Raster& raw, const Raster& picture);

struct PairedResponse {
  std::array<ResponsePoints, 3> curves;  // by the picture's code as sRGB; light 1 at code 1
  Eigen::Matrix3d rec709 = Eigen::Matrix3d::Identity();  // the raw's light = rec709 * curve(code)
  double sigma = 0;  // of the light that this leaves, relative; luminance
  int places = 0;    // that it was fitted to
};

// `raw` and `picture` in linear Rec. 709, the picture as its colour space states it. Rising curves
// and a matrix take turns, each by least squares over even places that neither has clipped;
// nullopt: fewer than 100 such places.
std::optional<PairedResponse> FitPairedResponse(const Raster& raw, const Raster& picture,
                                                const PairRegistration& registration);

}  // namespace insitu
