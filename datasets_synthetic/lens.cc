// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/lens.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"

namespace insitu::demo {
namespace {

double RadialFactor(const Lens& lens, double r2) {
  const auto& k = lens.distortion;
  return (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
}

Eigen::Vector2d TangentialShift(const Lens& lens, const Eigen::Vector2d& t) {
  const double p1 = lens.distortion[2], p2 = lens.distortion[3];
  const double r2 = t.squaredNorm(), xy = t.x() * t.y();
  return {2 * p1 * xy + p2 * (r2 + 2 * t.x() * t.x()), p1 * (r2 + 2 * t.y() * t.y()) + 2 * p2 * xy};
}

}  // namespace

Lens DemoLens(int width, int height) {
  Lens lens{width, height};
  lens.focal_x = 0.9412 * width;
  lens.focal_y = 0.9417 * width;
  lens.center_x = 0.5 * (width - 1) + 0.0051 * width;
  lens.center_y = 0.5 * (height - 1) - 0.0068 * width;
  lens.distortion = {-0.112, 0.041, 0.0004, -0.0003, 0, 0, 0, 0};
  return lens;
}

Eigen::Vector2d Distort(const Lens& lens, const Eigen::Vector2d& tangents) {
  return RadialFactor(lens, tangents.squaredNorm()) * tangents + TangentialShift(lens, tangents);
}

Eigen::Vector2d Undistort(const Lens& lens, const Eigen::Vector2d& distorted) {
  Eigen::Vector2d tangents = distorted;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d next =
        (distorted - TangentialShift(lens, tangents)) / RadialFactor(lens, tangents.squaredNorm());
    const double change = (next - tangents).norm();
    tangents = next;
    if (change < 1e-14) break;
  }
  return tangents;
}

std::optional<Eigen::Vector2d> Project(const Lens& lens, const Eigen::Vector3d& point_in_cam) {
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const Eigen::Vector2d seen = Distort(lens, point_in_cam.hnormalized());
  return Eigen::Vector2d(lens.focal_x * seen.x() + lens.center_x,
                         lens.focal_y * seen.y() + lens.center_y);
}

SightTable::SightTable(const Lens& lens) : columns_(lens.width + 1) {
  corners_.resize(static_cast<size_t>(columns_) * (lens.height + 1));
  tbb::parallel_for(0, lens.height + 1, [&](int row) {
    for (int column = 0; column <= lens.width; ++column) {
      const Eigen::Vector2d seen((column - 0.5 - lens.center_x) / lens.focal_x,
                                 (row - 0.5 - lens.center_y) / lens.focal_y);
      corners_[static_cast<size_t>(row) * columns_ + column] = Undistort(lens, seen);
    }
  });
}

Eigen::Vector2d SightTable::Tangents(const Eigen::Vector2d& pixel) const {
  const int rows = static_cast<int>(corners_.size()) / columns_;
  const Eigen::Vector2d at = pixel + Eigen::Vector2d(0.5, 0.5);
  const int column = std::clamp(static_cast<int>(at.x()), 0, columns_ - 2);
  const int row = std::clamp(static_cast<int>(at.y()), 0, rows - 2);
  INSITU_CHECK(at.minCoeff() >= 0 && at.x() <= columns_ - 1 && at.y() <= rows - 1);
  const double s = at.x() - column, t = at.y() - row;
  const Eigen::Vector2d* corner = &corners_[static_cast<size_t>(row) * columns_ + column];
  return (1 - t) * ((1 - s) * corner[0] + s * corner[1]) +
         t * ((1 - s) * corner[columns_] + s * corner[columns_ + 1]);
}

std::optional<Eigen::Vector2d> Project(const View& view, const Eigen::Vector3d& point) {
  return Project(view.lens, view.cam_from_site * (point - view.center));
}

}  // namespace insitu::demo
