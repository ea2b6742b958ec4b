// SPDX-License-Identifier: GPL-3.0-or-later
// The interior orientation of one camera: a lens model of mrcal and the size of its photographs.
// Pixel (0, 0) is the centre of the top-left pixel; camera axes are x right, y down, z forward.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/rigid3.h"

namespace insitu {

class Camera {
 public:
  // `lens_model` is one of mrcal's names, e.g. "LENSMODEL_OPENCV8"; `intrinsics` in mrcal's order
  // (fx fy cx cy distortion...), in pixels. Throws std::invalid_argument on an unknown model, a
  // wrong number of intrinsics, or a value that is not finite.
  Camera(const std::string& lens_model, std::vector<double> intrinsics, int width, int height);

  // How many intrinsics a lens model of mrcal has. Throws std::invalid_argument on an unknown one.
  static int IntrinsicsCount(const std::string& lens_model);

  static Camera Pinhole(double focal_x, double focal_y, double center_x, double center_y, int width,
                        int height);

  int width() const { return width_; }    // [px]
  int height() const { return height_; }  // [px]
  const std::string& lens_model() const { return lens_model_; }
  const std::vector<double>& intrinsics() const { return intrinsics_; }
  double focal_px() const { return intrinsics_[0]; }

  // Pixel of a point in the camera frame [m]; nullopt behind the camera (z <= 0).
  // `pixel_from_point`, if given, receives d pixel / d point [px/m].
  std::optional<Eigen::Vector2d> Project(
      const Eigen::Vector3d& point_in_cam,
      Eigen::Matrix<double, 2, 3>* pixel_from_point = nullptr) const;

  // As Project, with other values of the intrinsics, for their adjustment. `pixel_from_intrinsics`,
  // if given, receives d pixel / d intrinsics, 2 x n, row by row.
  std::optional<Eigen::Vector2d> ProjectWith(const double* intrinsics,
                                             const Eigen::Vector3d& point_in_cam,
                                             Eigen::Matrix<double, 2, 3>* pixel_from_point,
                                             double* pixel_from_intrinsics) const;

  // The names of intrinsics(): "fx", "fy", "cx", "cy", then those of the model's distortion, as
  // OpenCV calls them where it knows the model.
  std::vector<std::string> IntrinsicsNames() const;

  // Unit direction of sight of a pixel, camera frame. Iterative, inverts Project to about 1e-12.
  Eigen::Vector3d Unproject(const Eigen::Vector2d& pixel) const;

  // Whether a pixel position lies on the photograph (its outermost half pixels included).
  bool Sees(const Eigen::Vector2d& pixel) const;

 private:
  struct Lens;  // mrcal's description of the model
  std::string lens_model_;
  std::vector<double> intrinsics_;
  int width_, height_;
  std::shared_ptr<const Lens> lens_;
};

// A photograph's camera with its exterior orientation.
struct PosedCamera {
  std::string photo;  // file name without its ending
  Camera camera;
  Rigid3 cam_from_world;
};

// Reads a .cameramodel file of mrcal. Throws InputError.
Camera ReadCamera(const std::filesystem::path& path);
PosedCamera ReadPosedCamera(const std::filesystem::path& path);  // photo = the file's stem

// Writes a .cameramodel that mrcal's own tools read, with 17 digits: mrcal's C writer keeps six
// decimals, too few for national grids. `note` becomes a comment at its head.
void WritePosedCamera(const std::filesystem::path& path, const PosedCamera& posed,
                      const std::string& note);

}  // namespace insitu
