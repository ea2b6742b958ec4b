// SPDX-License-Identifier: GPL-3.0-or-later
// Linear light of every sRGB code, and the nearest code of light.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "calibration/color/color_space.h"

namespace insitu {

template <typename Code>
const std::vector<float>& LinearTable() {
  static const std::vector<float> table = [] {
    constexpr int kHighest = std::numeric_limits<Code>::max();
    std::vector<float> linear(kHighest + 1);
    for (int code = 0; code <= kHighest; ++code) {
      linear[code] = static_cast<float>(LinearFromSrgb(static_cast<double>(code) / kHighest));
    }
    return linear;
  }();
  return table;
}

// round(255 SrgbFromLinear(linear)), clamped to [0, 255]; NaN becomes 0. By a table: a quarter of
// the power's time.
uint8_t NearestSrgbCode(float linear);

}  // namespace insitu
