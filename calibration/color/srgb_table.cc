// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/srgb_table.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

namespace insitu {
namespace {

constexpr int kHighest = 255;
constexpr int kDropped = 16;  // bits of a float's fraction that a bin does not tell apart
constexpr uint32_t kOne = std::bit_cast<uint32_t>(1.0f);

int CodeByPower(float linear) {
  return static_cast<int>(std::lround(kHighest * SrgbFromLinear(linear)));
}

struct SrgbSteps {
  std::array<float, kHighest + 2> least = {};  // light of which a code is the nearest; none of 256
  std::array<uint8_t, (kOne >> kDropped) + 1> of_bin = {};  // code at the darkest light of a bin

  // Floats above 0 are in the order of their bits.
  SrgbSteps() {
    uint32_t bits = 0;
    for (int code = 1; code <= kHighest; ++code) {
      uint32_t above = kOne;  // the step is in (bits, above]
      while (above - bits > 1) {
        const uint32_t middle = bits + (above - bits) / 2;
        (CodeByPower(std::bit_cast<float>(middle)) < code ? bits : above) = middle;
      }
      least[code] = std::bit_cast<float>(above);
    }
    least[kHighest + 1] = std::numeric_limits<float>::infinity();
    for (size_t bin = 0; bin < of_bin.size(); ++bin) {
      const auto darkest = std::bit_cast<float>(static_cast<uint32_t>(bin) << kDropped);
      of_bin[bin] = static_cast<uint8_t>(CodeByPower(darkest));
    }
  }
};

}  // namespace

uint8_t NearestSrgbCode(float linear) {
  static const SrgbSteps steps;
  if (!(linear > 0)) return 0;
  if (linear >= 1) return kHighest;
  int code = steps.of_bin[std::bit_cast<uint32_t>(linear) >> kDropped];
  while (linear >= steps.least[code + 1]) ++code;
  return static_cast<uint8_t>(code);
}

}  // namespace insitu
