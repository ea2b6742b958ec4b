// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/raster.h"

#include <algorithm>

#include "calibration/files/error.h"

namespace insitu {

Eigen::Vector3d Interpolate(const Raster& image, const Eigen::Vector2d& pixel) {
  INSITU_CHECK(image.width > 0 && image.height > 0 && image.channels >= 3);
  const double x = std::clamp(pixel.x(), 0.0, image.width - 1.0);
  const double y = std::clamp(pixel.y(), 0.0, image.height - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  const double u = x - x0, v = y - y0;
  const Eigen::Vector3d above = (1 - u) * image.Rgb(x0, y0) + u * image.Rgb(x1, y0);
  const Eigen::Vector3d below = (1 - u) * image.Rgb(x0, y1) + u * image.Rgb(x1, y1);
  return (1 - v) * above + v * below;
}

}  // namespace insitu
