// SPDX-License-Identifier: GPL-3.0-or-later
// Pixels that the building's outline may spread into.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "renderer/trace/montage_scene.h"

namespace insitu {

// Which centres of the pixels of a tile and about it see the building.
class Outline {
 public:
  // For pixels of [left, right) x [top, bottom) of a photograph, spread over at most `reach`
  // pixels; `ray_of` gives the line of sight of a pixel, beyond the frame too.
  Outline(const MontageScene& scene, const Eigen::Vector2i& left_top,
          const Eigen::Vector2i& right_bottom, int reach,
          const std::function<Ray(const Eigen::Vector2d&)>& ray_of);

  // Whether some pixels within `reach` see the building and others do not.
  bool IsNear(int x, int y) const;

 private:
  Eigen::Vector2i origin_;
  int reach_, width_;
  bool is_mixed_ = false;  // in the whole tile
  std::vector<char> sees_building_;
};

}  // namespace insitu
