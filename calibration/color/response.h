// SPDX-License-Identifier: GPL-3.0-or-later
// A camera's response: how the light of its pictures differs from what their colour space says.
//
// response.json beside photographs states it, from a measurement or from `insitu light`:
//   {"curves": [{"photos": ["IMG_1"], "all": [[0, 0], [0.5, 0.19], [1, 1]]}]}
// Pairs of a code and of light in any unit, each rising; the code is what the picture has as sRGB,
// 0 to 1, channel by channel. "red", "green" and "blue" instead of "all"; without "photos", of all
// photographs of the folder that no other entry names. "matrix", three rows of three: linear
// Rec. 709 from the curves' light, which is 1 at the code 1; without it they are the same.
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

// The colour space of a photograph whose light is the curves' of what `stated` shows, through
// `rec709`.
ColorSpace WithResponse(const ColorSpace& stated, const std::array<ToneCurve, 3>& curves,
                        const Eigen::Matrix3d& rec709 = Eigen::Matrix3d::Identity());

// The same with what response.json beside the photograph says of it, if it does. Throws InputError,
// at its line: codes that do not rise from 0 to 1, light that does not rise from 0, a
// matrix that has no inverse.
ColorSpace WithResponseBeside(const std::filesystem::path& photograph, const ColorSpace& stated);

}  // namespace insitu
