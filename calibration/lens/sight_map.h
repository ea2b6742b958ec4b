// SPDX-License-Identifier: GPL-3.0-or-later
// Directions of sight of a whole photograph, fast: mrcal's unprojection on a coarse grid with
// bicubic interpolation between (the lens is smooth; a test holds the error below 1e-4 px).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/lens/camera.h"

namespace insitu {

class SightMap {
 public:
  explicit SightMap(const Camera& camera);

  // (x/z, y/z) of the direction of sight of a pixel position inside the frame, camera frame.
  Eigen::Vector2d Tangents(const Eigen::Vector2d& pixel) const;

  // Unit direction of sight, camera frame.
  Eigen::Vector3d Direction(const Eigen::Vector2d& pixel) const {
    return Tangents(pixel).homogeneous().normalized();
  }

 private:
  static constexpr int kSpacing = 8;  // [px]
  int columns_;
  std::vector<Eigen::Vector2d> tangents_;  // grid nodes, one beyond each border
};

}  // namespace insitu
