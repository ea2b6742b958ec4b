// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/image_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

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
  std::vector<ImageMark> marks;
  std::map<std::pair<std::string, std::string>, size_t> mark_index;  // by photo and point
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.kind != ObservationKind::kImage) continue;
    const auto [place, is_new] = mark_index.try_emplace({row.photo, row.subject}, marks.size());
    if (is_new) {
      marks.push_back({photo_index.at(row.photo), row.subject, Eigen::Vector2d::Zero(),
                       Eigen::Vector2d::Zero(), std::nullopt, row.is_tie_point});
    }
    ImageMark& mark = marks[place->second];
    mark.pixel[row.axis] = row.observed;
    mark.residual[row.axis] = row.residual;
    mark.w = LargerMagnitude(mark.w, row.w);
  }
  return marks;
}

std::map<std::string, double> LargestRayAngles(const Adjustment& adjustment,
                                               const std::vector<ImageMark>& marks) {
  std::map<std::string, Eigen::Vector3d> position;
  for (const AdjustedPoint& point : adjustment.points) position[point.name] = point.position;
  std::map<std::string, std::vector<Eigen::Vector3d>> rays;
  std::map<std::string, double> angles;
  for (const ImageMark& mark : marks) {
    const Rigid3& cam_from_world = adjustment.poses[mark.photo].cam_from_world;
    const Eigen::Vector3d ray = position.at(mark.point) - Center(cam_from_world);
    for (const Eigen::Vector3d& other : rays[mark.point]) {
      double& largest = angles[mark.point];
      largest = std::max(largest, std::atan2(ray.cross(other).norm(), ray.dot(other)));
    }
    rays[mark.point].push_back(ray);
  }
  return angles;
}

}  // namespace insitu
