// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph of another exposure than the site's unit: there to be rendered into, and back.
#pragma once

#include <Eigen/Core>

#include "calibration/photo/raster.h"
#include "radiometry/light/image_quality.h"

namespace insitu {

inline const Eigen::Vector3d kUnitGain = Eigen::Vector3d::Ones();

// The grain of a photograph after its values were divided by `gain`.
Grain GrainInUnit(const Grain& grain, const Eigen::Vector3d& gain);

// Pixels of `result` that are still those of `in_unit` become those of `photo`, bit for bit; all
// others are multiplied by `gain`. All of one size.
void BackToPhotograph(const Raster& photo, const Raster& in_unit, const Eigen::Vector3d& gain,
                      Raster* result);

}  // namespace insitu
