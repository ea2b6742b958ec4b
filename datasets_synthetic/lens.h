// SPDX-License-Identifier: GPL-3.0-or-later
// The demo site's camera: a pinhole behind OpenCV's rational distortion.
// Pixel (0, 0) is the centre of the top-left pixel; camera axes x right, y down, z forward.
#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace insitu::demo {

inline constexpr double kDegree = std::numbers::pi / 180;  // [rad]

struct Lens {
  int width = 0, height = 0;              // [px]
  double focal_x = 0, focal_y = 0;        // [px]
  double center_x = 0, center_y = 0;      // [px]
  std::array<double, 8> distortion = {};  // k1 k2 p1 p2 k3 k4 k5 k6
};

// The lens all photographs of the demo site are taken with, for a frame of this size.
Lens DemoLens(int width, int height);

// Tangents (x/z, y/z) of a sight -> those that a pinhole would need to see it where the lens does.
Eigen::Vector2d Distort(const Lens& lens, const Eigen::Vector2d& tangents);

// The inverse, by iteration to 1e-14.
Eigen::Vector2d Undistort(const Lens& lens, const Eigen::Vector2d& distorted);

// Pixel of a point in the camera frame; nullopt behind the camera.
std::optional<Eigen::Vector2d> Project(const Lens& lens, const Eigen::Vector3d& point_in_cam);

// Undistorted tangents all over the frame, exact at the corners of pixels, linear within a pixel.
class SightTable {
 public:
  explicit SightTable(const Lens& lens);

  // `pixel` within the frame, its outermost half pixels included.
  Eigen::Vector2d Tangents(const Eigen::Vector2d& pixel) const;

 private:
  int columns_;
  std::vector<Eigen::Vector2d> corners_;  // row-major; corner (0, 0) is pixel (-0.5, -0.5)
};

// A lens with its exterior orientation in the site frame.
struct View {
  std::string photo;
  Lens lens;
  Eigen::Vector3d center;         // [m]
  Eigen::Matrix3d cam_from_site;  // rotation
};

std::optional<Eigen::Vector2d> Project(const View& view, const Eigen::Vector3d& point);

}  // namespace insitu::demo
