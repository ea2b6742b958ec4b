// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/texture_coordinates.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace insitu {
namespace {

using Corners = std::array<Eigen::Vector2d, 3>;

// Along the face, right and up as one looks at its front.
std::optional<Corners> Projected(const ArtificialEnvironment& environment,
                                 const Eigen::Vector3i& triangle, const Eigen::Vector2d& size) {
  const auto at = [&](int corner) { return environment.vertices[triangle[corner]]; };
  const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  if (normal.isZero(0)) return std::nullopt;
  Eigen::Vector3d right = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitY();
  if (std::abs(normal.z()) < std::numbers::sqrt2 / 2) {
    right = Eigen::Vector3d::UnitZ().cross(normal).normalized();
    up = normal.cross(right);
  }
  Corners corners;
  for (int c = 0; c < 3; ++c) {
    corners[c] = {right.dot(at(c)) / size.x(), up.dot(at(c)) / size.y()};
  }
  return corners;
}

}  // namespace

std::optional<Corners> TextureCoordinates(const ArtificialEnvironment& environment, int triangle) {
  const auto& material = environment.materials[environment.material_of_triangle[triangle]];
  if (material.texture_size) {
    return Projected(environment, environment.triangles[triangle], *material.texture_size);
  }
  if (environment.corner_uvs.empty()) return std::nullopt;
  const Eigen::Vector2f* uv = &environment.corner_uvs[3 * static_cast<size_t>(triangle)];
  if (uv[0] == uv[1] && uv[0] == uv[2]) return std::nullopt;
  return Corners{uv[0].cast<double>(), uv[1].cast<double>(), uv[2].cast<double>()};
}

}  // namespace insitu
