// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid motions, named target-from-source: x_in_b = b_from_a * x_in_a.
#pragma once

#include <Eigen/Geometry>

namespace insitu {

// CrossMatrix(v) * w = v cross w.
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // [m], in the target frame

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
};

// c_from_a = c_from_b * b_from_a
inline Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

inline Rigid3 Inverse(const Rigid3& b_from_a) {
  const Eigen::Quaterniond inverse = b_from_a.rotation.conjugate();
  return {inverse, -(inverse * b_from_a.translation)};
}

// The centre of projection in the source frame (world, for cam_from_world).
inline Eigen::Vector3d Center(const Rigid3& cam_from_world) {
  return Inverse(cam_from_world).translation;
}

}  // namespace insitu
