// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs of a chessboard with the site's lens, for the calibration.
#pragma once

#include <vector>

#include "calibration/photo/raster.h"
#include "datasets_synthetic/lens.h"

namespace insitu::demo {

inline constexpr int kBoardCorners = 10;      // interior, along either side
inline constexpr double kBoardSquare = 0.08;  // [m]

// Grey, linear, slightly noisy; the whole board shows in each and together they fill the frame.
std::vector<Raster> BoardPhotos(const Lens& lens);

}  // namespace insitu::demo
