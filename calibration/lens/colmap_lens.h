// SPDX-License-Identifier: GPL-3.0-or-later
// COLMAP's cameras and pixels against ours. COLMAP counts pixels from the corner of the top-left
// one, (0.5, 0.5) being its centre; we, as mrcal, from its centre. Only this file converts.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"

namespace insitu {

inline Eigen::Vector2d ColmapFromPixel(const Eigen::Vector2d& pixel) { return pixel.array() + 0.5; }
inline Eigen::Vector2d PixelFromColmap(const Eigen::Vector2d& position) {
  return position.array() - 0.5;
}

// A camera in COLMAP's own terms. [colmap.github.io/cameras.html]
struct ColmapLens {
  std::string model;           // e.g. "FULL_OPENCV"
  int width = 0, height = 0;   // [px]
  std::vector<double> params;  // in COLMAP's order, principal point in COLMAP's pixels
  bool operator==(const ColmapLens&) const = default;
};

// A lens model as COLMAP's files number it (3.8 to 4.x).
struct ColmapLensModel {
  int id = 0;
  std::string name;
  int params = 0;  // how many
};
const std::vector<ColmapLensModel>& ColmapLensModels();
std::optional<ColmapLensModel> FindColmapLensModel(const std::string& name);
std::optional<ColmapLensModel> FindColmapLensModel(int id);

// The same lens exactly: PINHOLE, OPENCV (mrcal's OPENCV4) or FULL_OPENCV (OPENCV5, OPENCV8).
// nullopt: COLMAP has no equal (splined, thin prism, stereographic ... models).
std::optional<ColmapLens> ColmapFromCamera(const Camera& camera);

// The same lens exactly: SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV.
// nullopt: mrcal has no equal (fisheye, division ... models), or a number is not one of a lens.
std::optional<Camera> CameraFromColmap(const ColmapLens& lens);

}  // namespace insitu
