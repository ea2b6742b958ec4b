// SPDX-License-Identifier: GPL-3.0-or-later
// Removal of the lens distortion: photographs become the input images of [Durisch92, §4.1].
#pragma once

#include <Eigen/Core>
#include <optional>

#include "calibration/lens/camera.h"
#include "calibration/photo/raster.h"

namespace insitu {

// A pinhole camera at the same centre, same size, whose frame covers the photograph's corners as
// far as `camera` maps them, at the focal length that keeps the scale at the image centre or less.
Camera PinholeCovering(const Camera& camera);

// The mapping both ways. Positions may fall outside the target's frame; nullopt where the lens
// does not look (behind).
std::optional<Eigen::Vector2d> MapPixel(const Camera& target, const Camera& source,
                                        const Eigen::Vector2d& source_pixel);

// Resamples in linear light, bicubic; pixels that the source does not see become zero.
Raster Reproject(const Raster& source_image, const Camera& source, const Camera& target);

}  // namespace insitu
