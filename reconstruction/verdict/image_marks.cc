// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/image_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "calibration/files/error.h"
#include "calibration/lens/rigid3.h"

namespace insitu {
namespace {

std::optional<double> LargerMagnitude(std::optional<double> a, std::optional<double> b) {
  if (!a && !b) return std::nullopt;
  return std::max(std::abs(a.value_or(0)), std::abs(b.value_or(0)));
}

}  // namespace

std::vector<ImageMark> ImageMarks(const Adjustment& adjustment) {
  std::map<std::string, int> photo_index;
  for (size_t i = 0; i < adjustment.poses.size(); ++i) {
    photo_index[adjustment.poses[i].photo] = static_cast<int>(i);
  }
  std::vector<ImageMark> marks;  // a mark's x comes first, its y next
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.kind != ObservationKind::kImage) continue;
    if (row.axis == 0) {
      marks.push_back({photo_index.at(row.photo), row.subject, Eigen::Vector2d::Zero(),
                       Eigen::Vector2d::Zero(), std::nullopt, row.is_tie_point});
    }
    INSITU_CHECK(!marks.empty() && marks.back().point == row.subject);
    ImageMark& mark = marks.back();
    mark.pixel[row.axis] = row.observed;
    mark.residual[row.axis] = row.residual;
    mark.w = LargerMagnitude(mark.w, row.w);
  }
  return marks;
}

std::map<std::string, double> LargestRayAngles(const Adjustment& adjustment,
                                               const std::vector<ImageMark>& marks) {
  struct Rays {
    Eigen::Vector3d position;
    std::vector<Eigen::Vector3d> directions;
    double largest = 0;
  };
  std::unordered_map<std::string_view, Rays> rays_to;
  for (const AdjustedPoint& point : adjustment.points)
    rays_to[point.name].position = point.position;
  for (const ImageMark& mark : marks) {
    Rays& rays = rays_to.at(mark.point);
    const Eigen::Vector3d ray = rays.position - Center(adjustment.poses[mark.photo].cam_from_world);
    for (const Eigen::Vector3d& other : rays.directions) {
      rays.largest = std::max(rays.largest, std::atan2(ray.cross(other).norm(), ray.dot(other)));
    }
    rays.directions.push_back(ray);
  }
  std::map<std::string, double> angles;
  for (const auto& [point, rays] : rays_to) {
    if (rays.directions.size() > 1) angles.emplace(point, rays.largest);
  }
  return angles;
}

}  // namespace insitu
