// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/camera.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibration/files/error_at.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"

// mrcal's headers are C without a guard for C++; only this file includes them.
extern "C" {
#include <mrcal/mrcal.h>
}

namespace insitu {

struct Camera::Lens {
  mrcal_lensmodel_t model;
};

namespace {

mrcal_lensmodel_t LensModel(const std::string& name) {
  mrcal_lensmodel_t model;
  if (!mrcal_lensmodel_from_name(&model, name.c_str())) {
    throw std::invalid_argument("unknown lens model \"" + name + "\"");
  }
  if (!mrcal_lensmodel_metadata(&model).has_gradients) {
    throw std::invalid_argument("lens model \"" + name + "\" has no gradients in mrcal");
  }
  return model;
}

void CheckIntrinsics(const mrcal_lensmodel_t& model, const std::vector<double>& intrinsics) {
  const size_t expected = mrcal_lensmodel_num_params(&model);
  if (intrinsics.size() != expected) {
    throw std::invalid_argument(std::to_string(intrinsics.size()) + " intrinsics, expected " +
                                std::to_string(expected));
  }
  if (!std::all_of(intrinsics.begin(), intrinsics.end(), [](double v) { return std::isfinite(v); }))
    throw std::invalid_argument("an intrinsic that is not finite");
  if (intrinsics[0] <= 0 || intrinsics[1] <= 0) {
    throw std::invalid_argument("a focal length that is not positive");
  }
}

// One step of Newton's method on the direction's two degrees of freedom; mrcal's own iteration
// stops at about 1e-8 px.
Eigen::Vector3d Polished(const Camera& camera, const Eigen::Vector3d& direction,
                         const Eigen::Vector2d& pixel) {
  Eigen::Matrix<double, 2, 3> pixel_from_point;
  const auto projected = camera.Project(direction, &pixel_from_point);
  if (!projected) return direction;
  const Eigen::Vector3d across = direction.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> tangent_plane;
  tangent_plane << across, direction.cross(across);
  const Eigen::Matrix2d jacobian = pixel_from_point * tangent_plane;
  const Eigen::Vector2d step = jacobian.inverse() * (pixel - *projected);
  if (!step.allFinite() || step.norm() > 1e-6) return direction;
  return (direction + tangent_plane * step).normalized();
}

struct CameraModelFile {
  Camera camera;
  Rigid3 cam_from_world;
};

Rigid3 RigidFromRodrigues(const double* rt) {
  const Eigen::Vector3d rotation(rt[0], rt[1], rt[2]);
  const double angle = rotation.norm();
  Rigid3 pose;
  if (angle > 0) pose.rotation = Eigen::AngleAxisd(angle, rotation / angle);
  pose.translation = Eigen::Vector3d(rt[3], rt[4], rt[5]);
  return pose;
}

CameraModelFile ReadCameraModel(const std::filesystem::path& path) {
  const std::string content = ReadWhole(path);
  const auto free_model = [](mrcal_cameramodel_t* model) { mrcal_free_cameramodel(&model); };
  const std::unique_ptr<mrcal_cameramodel_t, decltype(free_model)> model(
      mrcal_read_cameramodel_string(content.data(), static_cast<int>(content.size())), free_model);
  if (content.empty() || !model) {
    throw ErrorAt(
        {path},
        Sentence("lensNone", "not a camera model, expected a complete .cameramodel of mrcal"));
  }
  char name[256];
  const double* first = model->intrinsics;
  const int count = mrcal_lensmodel_num_params(&model->lensmodel);
  if (!mrcal_lensmodel_name(name, sizeof(name), &model->lensmodel)) {
    throw ErrorAt({path}, Sentence("lensUnknown", "its lens model is unknown"));
  }
  const Rigid3 pose = RigidFromRodrigues(model->rt_cam_ref);
  if (!pose.translation.allFinite() || !pose.rotation.coeffs().allFinite()) {
    throw ErrorAt({path}, Sentence("lensExtrinsics", "its extrinsics are not finite"));
  }
  try {
    return {Camera(name, std::vector<double>(first, first + count),
                   static_cast<int>(model->imagersize[0]), static_cast<int>(model->imagersize[1])),
            pose};
  } catch (const std::invalid_argument& error) {
    throw InputError(path, error.what());
  }
}

// 17 digits: every double returns from them to the last bit.
template <typename Numbers>
std::string ListOf(const Numbers& numbers) {
  std::string list = "[ ";
  for (const double number : numbers) list += Formatted("%.17g, ", number);
  return list + "]";
}

std::string CommentOf(const std::string& note) {
  std::string comment = "# ";
  for (const char c : note) comment += c == '\n' ? std::string("\n# ") : std::string(1, c);
  return comment + "\n";
}

Eigen::Matrix<double, 6, 1> RodriguesFromRigid(const Rigid3& pose) {
  const Eigen::AngleAxisd rotation(pose.rotation);
  Eigen::Matrix<double, 6, 1> rt;
  rt << rotation.angle() * rotation.axis(), pose.translation;
  return rt;
}

}  // namespace

Camera::Camera(const std::string& lens_model, std::vector<double> intrinsics, int width, int height)
    : lens_model_(lens_model),
      intrinsics_(std::move(intrinsics)),
      width_(width),
      height_(height),
      lens_(std::make_shared<const Lens>(Lens{LensModel(lens_model)})) {
  CheckIntrinsics(lens_->model, intrinsics_);
  if (width <= 0 || height <= 0) throw std::invalid_argument("an image size that is not positive");
}

int Camera::IntrinsicsCount(const std::string& lens_model) {
  const mrcal_lensmodel_t model = LensModel(lens_model);
  return mrcal_lensmodel_num_params(&model);
}

Camera Camera::Pinhole(double focal_x, double focal_y, double center_x, double center_y, int width,
                       int height) {
  return Camera("LENSMODEL_PINHOLE", {focal_x, focal_y, center_x, center_y}, width, height);
}

std::optional<Eigen::Vector2d> Camera::Project(
    const Eigen::Vector3d& point_in_cam, Eigen::Matrix<double, 2, 3>* pixel_from_point) const {
  return ProjectWith(intrinsics_.data(), point_in_cam, pixel_from_point, nullptr);
}

std::optional<Eigen::Vector2d> Camera::ProjectWith(const double* intrinsics,
                                                   const Eigen::Vector3d& point_in_cam,
                                                   Eigen::Matrix<double, 2, 3>* pixel_from_point,
                                                   double* pixel_from_intrinsics) const {
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const mrcal_point3_t point = {{point_in_cam.x(), point_in_cam.y(), point_in_cam.z()}};
  mrcal_point2_t pixel;
  mrcal_point3_t gradient[2];
  INSITU_CHECK(mrcal_project(&pixel, pixel_from_point ? gradient : nullptr, pixel_from_intrinsics,
                             &point, 1, &lens_->model, intrinsics));
  if (pixel_from_point) {
    *pixel_from_point << gradient[0].x, gradient[0].y, gradient[0].z,  //
        gradient[1].x, gradient[1].y, gradient[1].z;
  }
  return Eigen::Vector2d(pixel.x, pixel.y);
}

std::vector<std::string> Camera::IntrinsicsNames() const {
  std::vector<std::string> names = {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2",
                                    "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"};
  const bool is_opencv = lens_model_.find("OPENCV") != std::string::npos;
  if (!is_opencv) names.resize(4);
  for (size_t i = names.size(); i < intrinsics_.size(); ++i) {
    names.push_back("distortion " + std::to_string(i - 3));
  }
  names.resize(intrinsics_.size());
  return names;
}

Eigen::Vector3d Camera::Unproject(const Eigen::Vector2d& pixel) const {
  const mrcal_point2_t q = {{pixel.x(), pixel.y()}};
  mrcal_point3_t v;
  INSITU_CHECK(mrcal_unproject(&v, &q, 1, &lens_->model, intrinsics_.data()));
  return Polished(*this, Eigen::Vector3d(v.x, v.y, v.z).normalized(), pixel);
}

bool Camera::Sees(const Eigen::Vector2d& pixel) const {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= width_ - 0.5 &&
         pixel.y() <= height_ - 0.5;
}

Camera ReadCamera(const std::filesystem::path& path) { return ReadCameraModel(path).camera; }

PosedCamera ReadPosedCamera(const std::filesystem::path& path) {
  const CameraModelFile file = ReadCameraModel(path);
  return {path.stem().string(), file.camera, file.cam_from_world};
}

void WritePosedCamera(const std::filesystem::path& path, const PosedCamera& posed,
                      const std::string& note) {
  const Camera& camera = posed.camera;
  WriteWhole(path, CommentOf(note) + "{\n    'lensmodel': '" + camera.lens_model() +
                       "',\n\n    # fx, fy, cx, cy, distortion\n    'intrinsics': " +
                       ListOf(camera.intrinsics()) +
                       ",\n\n    # rotation vector and translation, camera from world\n"
                       "    'extrinsics': " +
                       ListOf(RodriguesFromRigid(posed.cam_from_world)) +
                       ",\n\n    'imagersize': [ " + std::to_string(camera.width()) + ", " +
                       std::to_string(camera.height()) + ", ]\n}\n");
}

}  // namespace insitu
