// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph as its file has it.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "calibration/color/color_space.h"

namespace insitu {

// Codes of 8 or 16 bits, or numbers, in the file's colour space; three channels, rows of red, green
// and blue.
struct CodedPhotograph {
  int width = 0, height = 0;  // [px]
  std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> samples;
  ColorSpace color = {};
};

}  // namespace insitu
