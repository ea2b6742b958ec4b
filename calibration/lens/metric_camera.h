// SPDX-License-Identifier: GPL-3.0-or-later
// Interior orientations as photogrammetric programs state them: millimetres on the image plane, x
// right, y up. Their coefficients are not interchangeable with mrcal's.
//
// A pixel (u, v) of ours is at x_measured = (u - origin_px.x) pixel_mm.x, y_measured =
// -(v - origin_px.y) pixel_mm.y; a point (X, Y, Z) of the camera frame (y down) is ideally at
// x = c X / Z, y = -c Y / Z about the principal point.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/fit_camera.h"

namespace insitu {

enum class MetricModel {
  // Polynomials of the *measured* position correct it to the ideal one: PhotoModeler, Australis,
  // DBAT (its model 3, whose affinity acts about the principal point and before the lens).
  // Parameters c xp yp K1 K2 K3 P1 P2 aspect skew, with
  //   x = (1 + aspect) (x_measured - xp) + skew y,  y = y_measured - yp,  r^2 = x^2 + y^2,
  //   x_ideal = x + x (K1 r^2 + K2 r^4 + K3 r^6) + P1 (r^2 + 2 x^2) + 2 P2 x y,
  //   y_ideal = y + y (K1 r^2 + K2 r^4 + K3 r^6) + 2 P1 x y + P2 (r^2 + 2 y^2).
  kBackwardBrown,
  // Polynomials of the *ideal* position distort it, balanced to vanish at a radius r0: AICON 3D
  // Studio. Parameters c xh yh A1 A2 A3 B1 B2 C1 C2, with
  //   d = A1 (r^2 - r0^2) + A2 (r^4 - r0^4) + A3 (r^6 - r0^6),
  //   x_measured = x + xh + x d + B1 (r^2 + 2 x^2) + 2 B2 x y + C1 x + C2 y,
  //   y_measured = y + yh + y d + B2 (r^2 + 2 y^2) + 2 B1 x y.
  kBalancedRadial,
};

struct MetricCamera {
  MetricModel model = MetricModel::kBackwardBrown;
  int width = 0, height = 0;                            // [px]
  Eigen::Vector2d pixel_mm = Eigen::Vector2d::Zero();   // width and height of a pixel [mm], > 0
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  // where measured mm count from: DBAT the
                                                        // top-left corner, AICON the middle
  double balanced_radius_mm = 0;                        // r0, of kBalancedRadial only
  std::vector<double> parameters;  // c > 0; ten, in the order above [mm, mm^-2 ...]
};

// "c", "xp", ... in the order of MetricCamera::parameters.
const std::vector<std::string>& ParameterNames(MetricModel model);

// Pixel of a point in the camera frame [m]; nullopt: behind the camera, or where the polynomials
// fold over so that no pixel sees it.
std::optional<Eigen::Vector2d> ProjectMetric(const MetricCamera& camera,
                                             const Eigen::Vector3d& point_in_cam);

// Unit direction of sight of a pixel, camera frame; nullopt where the polynomials fold over.
std::optional<Eigen::Vector3d> UnprojectMetric(const MetricCamera& camera,
                                               const Eigen::Vector2d& pixel);

// The nearest OPENCV8 lens; nullopt as FitCamera.
std::optional<CameraFit> FitMetricCamera(const MetricCamera& camera);

}  // namespace insitu
