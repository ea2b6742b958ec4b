// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/interreflected_light.h"

#include <algorithm>

#include "renderer/trace/light_split.h"

namespace insitu {
namespace {

constexpr double kPiecesAcross = 48;    // the building
constexpr double kSmallestPiece = 0.1;  // [m]
constexpr double kSmallestOf = 1e-3;    // of the building's size: edge of the finest triangles
constexpr double kCalmOf = 1.0 / 40;    // of the building's size

std::vector<Spectrum> DiffuseBrdfs(const MontageScene& scene) {
  std::vector<Spectrum> brdfs;
  for (const SpectralMaterial& material : scene.artificial_materials) {
    brdfs.push_back(material.diffuse_weight * material.brdf);
  }
  return brdfs;
}

// About the building; without one, about the site.
Eigen::AlignedBox3d FocusOf(const MontageScene& scene) {
  Eigen::AlignedBox3d box;
  const bool is_planned = !scene.artificial_mesh.vertices.empty();
  const TriangleMesh& mesh = is_planned ? scene.artificial_mesh : scene.natural_mesh;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  if (box.isEmpty()) box.extend(Eigen::Vector3d::Zero());
  return box;
}

PatchGrid GridAbout(const Eigen::AlignedBox3d& focus) {
  return {{focus}, std::max(kSmallestPiece, focus.diagonal().norm() / kPiecesAcross)};
}

Daylight OpenSky(Daylight light) {
  light.sky_radiance += light.ambient_radiance;
  return light;
}

IrradianceMapOptions MapOptions(const MontageScene& scene) {
  const double size = FocusOf(scene).diagonal().norm();
  IrradianceMapOptions options;
  options.smallest = std::max(options.smallest, kSmallestOf * size);
  options.calm = std::max(options.smallest, kCalmOf * size);
  return options;
}

IrradianceMapOptions SiteMapOptions(const MontageScene& scene) {
  IrradianceMapOptions options = MapOptions(scene);
  if (!scene.artificial_mesh.vertices.empty()) options.building = FocusOf(scene);
  return options;
}

std::vector<Eigen::Vector3d> NaturalNormals(const MontageScene& scene) {
  std::vector<Eigen::Vector3d> normals;
  for (int polygon : scene.polygon_of_triangle) {
    normals.push_back(scene.natural.scene.polygons[polygon].normal);
  }
  return normals;
}

std::function<Spectrum(const SurfacePoint&)> LampsOf(const MontageScene& scene) {
  if (scene.lamps.empty()) return {};
  const LightDirections middle{.sun = scene.natural.light.sun_direction,
                               .facet = Eigen::Vector2d::Zero()};
  return
      [&scene, middle](const SurfacePoint& point) { return LampIrradiance(scene, point, middle); };
}

}  // namespace

InterreflectedLight::InterreflectedLight(const MontageScene& scene, std::optional<int> bounces)
    : artificial_brdfs(DiffuseBrdfs(scene)),
      transport{scene.Photographed(),
                scene.natural_mesh,
                {scene.artificial_mesh, scene.artificial_rays, scene.artificial_normals,
                 scene.material_of_triangle, artificial_brdfs},
                LampsOf(scene)},
      interreflection(transport, scene.natural.light, GridAbout(FocusOf(scene)),
                      {.bounces = bounces}),
      on_site(interreflection, scene.natural_mesh, NaturalNormals(scene), SiteMapOptions(scene)),
      on_building(interreflection, scene.artificial_mesh, scene.artificial_normals,
                  MapOptions(scene)) {
  interreflection.Solve(OpenSky(scene.natural.light));
}

void AddInterreflection(MontageScene* scene, std::optional<int> bounces) {
  scene->interreflected = std::make_shared<const InterreflectedLight>(*scene, bounces);
}

}  // namespace insitu
