// SPDX-License-Identifier: GPL-3.0-or-later
// Any lens as one of mrcal's: least squares over the frame, with the deviation that is left.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>

#include "calibration/lens/camera.h"

namespace insitu {

// 80 degrees off the axis: what a plane image shows beyond is of no use.
inline constexpr double kLargestTangent = 5.7;

// Where a lens looks: direction of sight (of any length > 0, camera frame) of a pixel; nullopt
// where it is undefined.
using SightOfPixel = std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector2d& pixel)>;

struct FitCameraOptions {
  std::string lens_model = "LENSMODEL_OPENCV8";
  // Whether the fit may turn the camera's axes. A scan of film that lies askew is such a camera
  // turned; where a photograph's pose is free, nothing is lost.
  bool turn_axes = false;
  Eigen::Quaterniond start_fit_from_lens = Eigen::Quaterniond::Identity();
};

struct CameraFit {
  Camera camera;
  Eigen::Quaterniond fit_from_lens = Eigen::Quaterniond::Identity();  // turned camera axes
  double largest_deviation_px = 0;  // |fitted pixel - the lens's own| over the frame
  double rms_deviation_px = 0;
};

// Least squares of the pixels over the whole frame, its outermost half pixels included. nullopt:
// somewhere in the frame the lens looks nowhere, or farther than 80 degrees off the axis.
std::optional<CameraFit> FitCamera(const SightOfPixel& sight_of_pixel, int width, int height,
                                   const FitCameraOptions& options = {});

}  // namespace insitu
