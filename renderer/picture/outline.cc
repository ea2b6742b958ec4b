// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/picture/outline.h"

#include <algorithm>

#include "renderer/trace/trace.h"

namespace insitu {

Outline::Outline(const MontageScene& scene, const Eigen::Vector2i& left_top,
                 const Eigen::Vector2i& right_bottom, int reach,
                 const std::function<Ray(const Eigen::Vector2d&)>& ray_of)
    : origin_(left_top - Eigen::Vector2i::Constant(reach)),
      reach_(reach),
      width_(right_bottom.x() - left_top.x() + 2 * reach) {
  if (scene.building_box.IsEmpty()) return;
  const int height = right_bottom.y() - left_top.y() + 2 * reach;
  sees_building_.reserve(static_cast<size_t>(width_) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Ray ray = ray_of((origin_ + Eigen::Vector2i(x, y)).cast<double>());
      sees_building_.push_back(HitsBuilding(scene, ray) ? 1 : 0);
    }
  }
  const auto [least, most] = std::minmax_element(sees_building_.begin(), sees_building_.end());
  is_mixed_ = *least != *most;
}

bool Outline::IsNear(int x, int y) const {
  if (!is_mixed_) return false;
  const auto at = [&](int dx, int dy) {
    return sees_building_[static_cast<size_t>(y - origin_.y() + dy) * width_ + x - origin_.x() +
                          dx];
  };
  const char here = at(0, 0);
  for (int dy = -reach_; dy <= reach_; ++dy) {
    for (int dx = -reach_; dx <= reach_; ++dx) {
      if (at(dx, dy) != here) return true;
    }
  }
  return false;
}

}  // namespace insitu
