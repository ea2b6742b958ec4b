// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/ideal_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"
#include "calibration/lens/fit_camera.h"

namespace insitu {
namespace {

constexpr int kSteps = 64;  // along each side of the photograph

// (x / z, y / z) of a pixel's sight.
Eigen::Vector2d Tangents(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d sight = camera.Unproject(pixel);
  const double across = sight.head<2>().norm();
  if (across <= kLargestTangent * sight.z()) return sight.head<2>() / sight.z();
  return kLargestTangent / across * sight.head<2>();
}

}  // namespace

Camera IdealFrame(const Camera& camera) {
  Eigen::Matrix<double, 2, 3> pixel_from_point;
  INSITU_CHECK(camera.Project(Eigen::Vector3d::UnitZ(), &pixel_from_point).has_value());
  const Eigen::Array2d focal(pixel_from_point(0, 0), pixel_from_point(1, 1));
  Eigen::AlignedBox2d box(Eigen::Vector2d(0, 0));  // the principal point
  for (int i = 0; i <= kSteps; ++i) {
    const double x = -0.5 + camera.width() * i / double{kSteps};
    const double y = -0.5 + camera.height() * i / double{kSteps};
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(x, -0.5), Eigen::Vector2d(x, camera.height() - 0.5),
          Eigen::Vector2d(-0.5, y), Eigen::Vector2d(camera.width() - 0.5, y)}) {
      box.extend(Tangents(camera, pixel));
    }
  }
  const Eigen::Array2d low = focal * box.min().array() - 1, high = focal * box.max().array() + 1;
  const Eigen::Array2d size = (high - low).ceil();
  return Camera::Pinhole(focal.x(), focal.y(), -low.x(), -low.y(), static_cast<int>(size.x()),
                         static_cast<int>(size.y()));
}

Eigen::Vector2d IdealFromPixel(const Camera& ideal, const Camera& camera,
                               const Eigen::Vector2d& pixel) {
  const auto projected = ideal.Project(Tangents(camera, pixel).homogeneous());
  INSITU_CHECK(projected.has_value());
  return *projected;
}

}  // namespace insitu
