// SPDX-License-Identifier: GPL-3.0-or-later
// What a picture holds at a pixel.
#pragma once

#include <Eigen/Core>

namespace insitu {

struct PixelValue {
  Eigen::Vector3d linear;   // Rec. 709
  Eigen::Vector3d encoded;  // sRGB, [0, 1]; beyond for an EXR and colours beyond sRGB
};

}  // namespace insitu
