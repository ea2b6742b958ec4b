// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/undistort.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"
#include "calibration/lens/interpolate_bicubic.h"
#include "calibration/lens/sight_map.h"

namespace insitu {
namespace {

// A plane cannot hold a wider field; directions farther from the axis are given up.
const double kWidestCosine = std::cos(1.3);  // about 75 degrees

// The tangents (x/z, y/z) along the photograph's border.
Eigen::AlignedBox2d BorderTangents(const Camera& camera) {
  Eigen::AlignedBox2d box;
  const auto extend = [&](double x, double y) {
    const Eigen::Vector3d sight = camera.Unproject({x - 0.5, y - 0.5});
    if (sight.z() > kWidestCosine) box.extend(sight.hnormalized());
  };
  for (int x = 0; x <= camera.width(); ++x) {
    extend(x, 0);
    extend(x, camera.height());
  }
  for (int y = 0; y <= camera.height(); ++y) {
    extend(0, y);
    extend(camera.width(), y);
  }
  return box;
}

// Pixels per unit of tangent at the image centre, the geometric mean of both directions.
double CenterScale(const Camera& camera) {
  const Eigen::Vector2d center((camera.width() - 1) / 2.0, (camera.height() - 1) / 2.0);
  const Eigen::Vector3d sight = camera.Unproject(center);
  Eigen::Matrix<double, 2, 3> pixel_from_point;
  camera.Project(sight / sight.z(), &pixel_from_point);
  return std::sqrt(std::abs(pixel_from_point.leftCols<2>().determinant()));
}

}  // namespace

Camera PinholeCovering(const Camera& camera) {
  const Eigen::AlignedBox2d box = BorderTangents(camera);
  INSITU_CHECK(!box.isEmpty());
  const Eigen::Array2d frame(camera.width(), camera.height());
  const double focal = std::min(CenterScale(camera), (frame / box.sizes().array()).minCoeff());
  const Eigen::Array2d center = (frame - 1) / 2 - focal * box.center().array();
  return Camera::Pinhole(focal, focal, center.x(), center.y(), camera.width(), camera.height());
}

std::optional<Eigen::Vector2d> MapPixel(const Camera& target, const Camera& source,
                                        const Eigen::Vector2d& source_pixel) {
  return target.Project(source.Unproject(source_pixel));
}

Raster Reproject(const Raster& source_image, const Camera& source, const Camera& target) {
  INSITU_CHECK(source_image.width == source.width() && source_image.height == source.height());
  const SightMap sights(target);
  Raster image(target.width(), target.height());
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const auto pixel = source.Project(sights.Direction(Eigen::Vector2d(x, y)));
      if (pixel && source.Sees(*pixel)) {
        image.SetRgb(x, y, InterpolateBicubic(source_image, *pixel));
      }
    }
  });
  return image;
}

}  // namespace insitu
