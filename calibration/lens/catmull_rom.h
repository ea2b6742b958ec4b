// SPDX-License-Identifier: GPL-3.0-or-later
// The interpolating cubic through evenly spaced samples.
#pragma once

#include <array>

namespace insitu {

// Weights of four neighbouring samples for a position `t` in [0, 1] past the second one.
inline std::array<double, 4> CatmullRomWeights(double t) {
  return {t * (t * (2 - t) - 1) / 2, (t * t * (3 * t - 5) + 2) / 2, t * (t * (4 - 3 * t) + 1) / 2,
          t * t * (t - 1) / 2};
}

}  // namespace insitu
