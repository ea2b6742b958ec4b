// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/epipolar_curve.h"

namespace insitu {

std::vector<Polyline> EpipolarCurve(const PosedCamera& camera, const Eigen::Vector2d& pixel,
                                    const PosedCamera& other, double tolerance_px) {
  const Eigen::Vector3d sight =
      camera.cam_from_world.rotation.conjugate() * camera.camera.Unproject(pixel);
  const Eigen::Vector3d base = Center(camera.cam_from_world) - Center(other.cam_from_world);
  if (!sight.allFinite() || !(base.norm() > 1e-9)) return {};
  // From the other camera the ray runs from its direction at infinity to the first camera's centre.
  const Eigen::Quaterniond& turn = other.cam_from_world.rotation;
  return ImageOfArc(LensView(other.camera), turn * sight, turn * base, tolerance_px);
}

}  // namespace insitu
