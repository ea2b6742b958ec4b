// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of drawings: AutoCAD's colour index and true colours.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace insitu {

// Linear Rec. 709 of an 0xRRGGBB sRGB colour.
Eigen::Vector3d LinearFromSrgb24(uint32_t rgb);

// Linear Rec. 709 of AutoCAD's colour index 1 to 255; nullopt for any other number.
std::optional<Eigen::Vector3d> ColorOfIndex(int index);

}  // namespace insitu
