// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/shown_environment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "reconstruction/geometry/sphere_facets.h"

namespace insitu {

ArtificialEnvironment Faceted(ArtificialEnvironment environment, int level) {
  if (environment.spheres.empty()) return environment;
  const SphereFacets unit = UnitSphereFacets(level);
  const bool has_normals = !environment.corner_normals.empty();
  for (const EnvironmentSphere& sphere : environment.spheres) {
    const int first = static_cast<int>(environment.vertices.size());
    for (const Eigen::Vector3d& vertex : unit.vertices) {
      environment.vertices.push_back(sphere.center + sphere.radius * vertex);
    }
    for (const Eigen::Vector3i& facet : unit.triangles) {
      environment.triangles.push_back(facet + Eigen::Vector3i::Constant(first));
      environment.material_of_triangle.push_back(sphere.material);
      for (const int corner : facet) {
        if (has_normals) environment.corner_normals.push_back(unit.vertices[corner].cast<float>());
      }
    }
  }
  if (!environment.corner_uvs.empty()) {
    environment.corner_uvs.resize(3 * environment.triangles.size(), Eigen::Vector2f(0, 0));
  }
  environment.spheres.clear();
  return environment;
}

namespace {

// Along the face, right and up as one looks at its front.
std::optional<std::array<Eigen::Vector2d, 3>> Projected(const ArtificialEnvironment& environment,
                                                        const Eigen::Vector3i& triangle,
                                                        const Eigen::Vector2d& size) {
  const auto at = [&](int corner) { return environment.vertices[triangle[corner]]; };
  const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  if (normal.isZero(0)) return std::nullopt;
  Eigen::Vector3d right = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitY();
  if (std::abs(normal.z()) < std::numbers::sqrt2 / 2) {
    right = Eigen::Vector3d::UnitZ().cross(normal).normalized();
    up = normal.cross(right);
  }
  std::array<Eigen::Vector2d, 3> corners;
  for (int c = 0; c < 3; ++c) {
    corners[c] = {right.dot(at(c)) / size.x(), up.dot(at(c)) / size.y()};
  }
  return corners;
}

}  // namespace

std::optional<std::array<Eigen::Vector2d, 3>> TextureCoordinates(
    const ArtificialEnvironment& environment, int triangle) {
  const auto& material = environment.materials[environment.material_of_triangle[triangle]];
  if (material.texture_size) {
    return Projected(environment, environment.triangles[triangle], *material.texture_size);
  }
  if (environment.corner_uvs.empty()) return std::nullopt;
  const Eigen::Vector2f* uv = &environment.corner_uvs[3 * static_cast<size_t>(triangle)];
  if (uv[0] == uv[1] && uv[0] == uv[2]) return std::nullopt;
  return {{uv[0].cast<double>(), uv[1].cast<double>(), uv[2].cast<double>()}};
}

namespace {

// A face that shows nothing of its material's texture.
bool HasFaceWithoutTexture(const ArtificialEnvironment& environment,
                           const SurfaceMaterial& material) {
  if (material.texture.empty() && material.maps.empty()) return false;
  const auto index = &material - environment.materials.data();
  for (size_t t = 0; t < environment.triangles.size(); ++t) {
    if (environment.material_of_triangle[t] != index) continue;
    if (!TextureCoordinates(environment, static_cast<int>(t))) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> NotShown(const ArtificialEnvironment& environment) {
  std::vector<std::string> lines;
  for (const SurfaceMaterial& material : environment.materials) {
    const std::string name = "material \"" + material.name + "\": ";
    if (material.glass && material.bumps)
      lines.push_back(name + "its glass is shown without bumps");
    const auto is_of_glass = [](const SurfaceMap& map) {
      return map.kind == SurfaceMap::Kind::kTransmission;
    };
    if (material.glass && !std::ranges::all_of(material.maps, is_of_glass)) {
      lines.push_back(name + "its glass is shown without relief and of the mean roughness");
    }
    if (HasFaceWithoutTexture(environment, material)) {
      lines.push_back(name +
                      "faces without texture coordinates show the mean of its texture and maps: "
                      "state \"texture_size_m\": [width, height] of a repeat");
    }
  }
  std::set<int> on_spheres;
  for (const EnvironmentSphere& sphere : environment.spheres) on_spheres.insert(sphere.material);
  for (const int material : on_spheres) {
    const SurfaceMaterial& shown = environment.materials[material];
    if (shown.texture.empty() && shown.maps.empty()) continue;
    lines.push_back("material \"" + shown.name +
                    "\": spheres show the mean of its texture and maps");
  }
  for (const PointLight& light : environment.lights) {
    if (light.candela == 0 || light.intensity_rgb.maxCoeff() > 0) continue;
    lines.push_back("light \"" + light.name +
                    "\" is not shown: lights.json does not say what luminance the site's unit is "
                    "(site_luminance_cd_m2)");
  }
  return lines;
}

}  // namespace insitu
