// SPDX-License-Identifier: GPL-3.0-or-later
// A camera's response: how the light of its pictures differs from what their colour space says.
//
// response.json beside photographs states it, from a measurement or from `insitu light`:
//   {"curves": [{"photos": ["IMG_1"], "all": [[0, 0], [0.5, 0.19], [1, 1]]}]}
// Pairs of a code and of light in any unit, each rising; the code is what the picture has as sRGB,
// 0 to 1, channel by channel. "red", "green" and "blue" instead of "all"; without "photos", of all
// photographs of the folder that no other entry names.
#pragma once

#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include "calibration/color/color_space.h"

namespace insitu {

using ResponsePoints = std::vector<std::pair<double, double>>;  // code, light

// The light at 1 is 1. Between the points a cubic that is monotone as they are [Fritsch, Carlson
// 1980]. Points as of response.json.
ToneCurve ResponseCurve(const ResponsePoints& points);

// The colour space of a photograph whose light is the curves' of what `stated` shows.
ColorSpace WithResponse(const ColorSpace& stated, const std::array<ToneCurve, 3>& curves);

// The same with what response.json beside the photograph says of it, if it does. Throws InputError,
// at its line: codes that do not rise from 0 to 1, light that does not rise from 0.
ColorSpace WithResponseBeside(const std::filesystem::path& photograph, const ColorSpace& stated);

}  // namespace insitu
