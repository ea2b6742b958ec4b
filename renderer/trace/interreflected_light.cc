// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/interreflected_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "calibration/files/error.h"
#include "renderer/trace/light_split.h"
#include "renderer/trace/through_glass.h"

namespace insitu {
namespace {

constexpr double kPiecesAcross = 48;    // the building
constexpr double kSmallestPiece = 0.1;  // [m]
constexpr double kSmallestOf = 1e-3;    // of the building's size: edge of the finest triangles
constexpr double kCalmOf = 1.0 / 40;    // of the building's size
// A building of the size beyond which it is taken for a long or scattered one, whose pieces and
// triangles shrink to what its surface asks for. [m]
constexpr double kLargeBuilding = 250;
constexpr double kPiecesOfSurface = 5400;  // about as many as a cube has by kPiecesAcross

std::vector<Spectrum> DiffuseBrdfs(const MontageScene& scene) {
  std::vector<Spectrum> brdfs;
  for (const SpectralMaterial& material : scene.artificial_materials) {
    brdfs.push_back((1 - material.metal_share) * material.diffuse_weight * material.brdf);
  }
  return brdfs;
}

std::vector<Spectrum> TranslucencesOf(const MontageScene& scene) {
  std::vector<Spectrum> translucences;
  for (const SpectralMaterial& material : scene.artificial_materials) {
    translucences.push_back(material.translucence);
  }
  return translucences;
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

// The building's surface and the ground in its box. [m^2]
double SurfaceIn(const MontageScene& scene, const Eigen::AlignedBox3d& focus) {
  const Eigen::Vector3d sizes = focus.sizes();
  double area = sizes.x() * sizes.y();
  for (const Eigen::Vector3i& triangle : scene.artificial_mesh.triangles) {
    const Eigen::Vector3f& a = scene.artificial_mesh.vertices[triangle[0]];
    const Eigen::Vector3f u = scene.artificial_mesh.vertices[triangle[1]] - a;
    const Eigen::Vector3f v = scene.artificial_mesh.vertices[triangle[2]] - a;
    area += u.cross(v).norm() / 2;
  }
  return area;
}

PatchGrid GridAbout(const MontageScene& scene, const Eigen::AlignedBox3d& focus, int coarseness) {
  const double size = focus.diagonal().norm();
  double piece = std::max(kSmallestPiece, size / kPiecesAcross);
  if (size > kLargeBuilding && !scene.artificial_mesh.vertices.empty()) {
    const double of_surface = std::sqrt(SurfaceIn(scene, focus) / kPiecesOfSurface);
    piece = std::clamp(of_surface, kLargeBuilding / kPiecesAcross, piece);
  }
  return {{focus}, coarseness * piece};
}

Daylight OpenSky(Daylight light) {
  light.sky_radiance += light.ambient_radiance;
  return light;
}

IrradianceMapOptions MapOptions(const MontageScene& scene, int coarseness) {
  const double size = std::min(kLargeBuilding, FocusOf(scene).diagonal().norm());
  IrradianceMapOptions options;
  options.smallest = coarseness * std::max(options.smallest, kSmallestOf * size);
  options.calm = std::max(options.smallest, coarseness * kCalmOf * size);
  options.tolerance *= coarseness;
  return options;
}

IrradianceMapOptions SiteMapOptions(const MontageScene& scene, int coarseness) {
  IrradianceMapOptions options = MapOptions(scene, coarseness);
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

OpaqueFaces OpaqueFacesOf(const MontageScene& scene) {
  OpaqueFaces faces;
  if (!scene.split_faces) return faces;
  for (int triangle : scene.split_faces->opaque.triangles) {
    faces.normals.push_back(scene.artificial_normals[triangle]);
    faces.material_of_triangle.push_back(scene.material_of_triangle[triangle]);
  }
  return faces;
}

// Materials of glass, numbered as they come.
std::vector<int> KindsOfPanes(const MontageScene& scene) {
  std::vector<int> kinds;
  if (!scene.split_faces) return kinds;
  std::map<int, int> kind_of_material;
  for (int triangle : scene.split_faces->clear.triangles) {
    const int next = static_cast<int>(kind_of_material.size());
    kinds.push_back(
        kind_of_material.try_emplace(scene.material_of_triangle[triangle], next).first->second);
  }
  return kinds;
}

// The mean way through a convex body is 4 V / S (Cauchy).
double MeanWay(const MontageScene& scene, int material) {
  double volume = 0, area = 0;
  for (int triangle : scene.split_faces->clear.triangles) {
    if (scene.material_of_triangle[triangle] != material) continue;
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) {
      corners.col(i) = scene.artificial_mesh.vertices[scene.artificial_mesh.triangles[triangle][i]]
                           .cast<double>();
    }
    volume += corners.determinant() / 6;
    area += (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
  }
  return area > 0 ? 4 * std::abs(volume) / area : 0;
}

// Of a pane, or of one face of a body and half the way through it, by classes of the cosine.
std::array<Spectrum, ClearFaces::kClasses> TransmittancesOf(const MontageScene& scene,
                                                            int material) {
  const SpectralGlass& glass = *scene.artificial_materials[material].glass;
  const Spectrum within = glass.is_solid
                              ? Spectrum((-glass.absorption * (MeanWay(scene, material) / 2)).exp())
                              : Spectrum::Ones().eval();
  std::array<Spectrum, ClearFaces::kClasses> classes;
  for (int i = 0; i < ClearFaces::kClasses; ++i) {
    const double cosine = (i + 0.5) / ClearFaces::kClasses;
    classes[i] = glass.weight * within *
                 (glass.is_solid ? Spectrum::Constant(FaceTransmittance(glass, cosine)).eval()
                                 : PaneOptics(glass, cosine).transmittance);
  }
  return classes;
}

std::optional<ClearFaces> ClearFacesOf(const MontageScene& scene, const std::vector<int>& kinds) {
  if (!scene.split_faces) return std::nullopt;
  const FaceSubset& faces = scene.split_faces->clear;
  ClearFaces clear{faces.mesh, faces.rays, kinds, {}, [&scene](const Ray& ray) {
                     return TransmittanceAlong(scene, ray);
                   }};
  for (size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] < std::ssize(clear.transmittance)) continue;
    clear.transmittance.push_back(
        TransmittancesOf(scene, scene.material_of_triangle[faces.triangles[i]]));
  }
  return clear;
}

PlannedFaces PlannedOf(const MontageScene& scene, const OpaqueFaces& opaque,
                       const std::vector<Spectrum>& brdfs,
                       const std::vector<Spectrum>& translucences, const ClearFaces* clear) {
  if (!clear) {
    return {scene.artificial_mesh,
            scene.artificial_rays,
            scene.artificial_normals,
            scene.material_of_triangle,
            brdfs,
            nullptr,
            &translucences};
  }
  const FaceSubset& faces = scene.split_faces->opaque;
  return {faces.mesh, faces.rays, opaque.normals, opaque.material_of_triangle,
          brdfs,      clear,      &translucences};
}

InterreflectionOptions OptionsOf(std::optional<int> bounces, int coarseness) {
  InterreflectionOptions options{.bounces = bounces};
  options.patch_directions /= coarseness * coarseness;
  options.point_directions /= coarseness * coarseness;
  return options;
}

// What each piece meets, which solving takes, is let go: it is the largest part by far.
Interreflection SolvedAmong(const TransportScene& transport, const MontageScene& scene,
                            const InterreflectionOptions& options, const KeptLight* kept,
                            int coarseness) {
  const Daylight& light = scene.natural.light;
  const PatchGrid grid = GridAbout(scene, FocusOf(scene), coarseness);
  if (kept) return {transport, light, grid, kept->solved, options};
  Interreflection solved(transport, light, grid, options);
  solved.Solve(OpenSky(light));
  return {transport, light, grid, solved.Solution(), options};
}

std::span<const KeptPoint> PointsOf(const KeptLight* kept,
                                    std::vector<KeptPoint> KeptLight::*points) {
  return kept ? std::span<const KeptPoint>(kept->*points) : std::span<const KeptPoint>();
}

}  // namespace

InterreflectedLight::InterreflectedLight(const MontageScene& scene, std::optional<int> bounces,
                                         const KeptLight* kept, int coarseness)
    : artificial_brdfs(DiffuseBrdfs(scene)),
      translucences(TranslucencesOf(scene)),
      opaque(OpaqueFacesOf(scene)),
      kind_of_pane(KindsOfPanes(scene)),
      clear(ClearFacesOf(scene, kind_of_pane)),
      transport{
          scene.Photographed(), scene.natural_mesh,
          PlannedOf(scene, opaque, artificial_brdfs, translucences, clear ? &*clear : nullptr),
          LampsOf(scene)},
      interreflection(
          SolvedAmong(transport, scene, OptionsOf(bounces, coarseness), kept, coarseness)),
      on_site(interreflection, scene.natural_mesh, NaturalNormals(scene),
              SiteMapOptions(scene, coarseness), PointsOf(kept, &KeptLight::on_site)),
      on_building(interreflection, scene.artificial_mesh, scene.artificial_normals,
                  MapOptions(scene, coarseness), PointsOf(kept, &KeptLight::on_building)) {}

void AddInterreflection(MontageScene* scene, std::optional<int> bounces, const KeptLight* kept,
                        int coarseness) {
  INSITU_CHECK(coarseness == 1 || coarseness == 2 || coarseness == 4);
  scene->interreflected =
      std::make_shared<const InterreflectedLight>(*scene, bounces, kept, coarseness);
}

KeptLight KeptLightOf(const InterreflectedLight& light) {
  return {light.interreflection.Solution(), light.on_site.Kept(), light.on_building.Kept()};
}

}  // namespace insitu
