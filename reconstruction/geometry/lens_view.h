// SPDX-License-Identifier: GPL-3.0-or-later
// What a photograph really shows: the lens model where it can be trusted, and the images of
// straight lines through it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/lens/camera.h"

namespace insitu {

using Polyline = std::vector<Eigen::Vector2d>;  // [px]

// A lens model beyond the field that its photograph shows is an extrapolation: it folds, and puts
// things into the frame that the lens never saw.
class LensView {
 public:
  explicit LensView(const Camera& camera);

  // The pixel of a direction in the camera frame, of any length; nullopt: behind the camera, off
  // the frame, or further from the axis than any pixel looks, where the model folds.
  std::optional<Eigen::Vector2d> PixelOf(const Eigen::Vector3d& in_cam) const;

 private:
  Camera camera_;
  double least_cosine_ = 0;  // of an angle to the axis at which a pixel looks
};

// The image of the directions between two, as of a straight edge's ends: pieces within the frame,
// each no further than `tolerance_px` from the true curve. In the camera frame, of any length, not
// opposite to one another.
std::vector<Polyline> ImageOfArc(const LensView& view, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& to, double tolerance_px);

// The image of a closed outline [m], world; pieces of neighbouring edges that meet are one.
std::vector<Polyline> ImageOfOutline(const LensView& view, const Rigid3& cam_from_world,
                                     const std::vector<Eigen::Vector3d>& vertices,
                                     double tolerance_px);

}  // namespace insitu
