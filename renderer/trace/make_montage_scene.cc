// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/make_montage_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "calibration/files/error.h"
#include "radiometry/spectrum/spectral_table.h"
#include "renderer/building/shown_environment.h"
#include "renderer/trace/mean_brdf.h"

namespace insitu {
namespace {

TriangleMesh LocalMesh(const ArtificialEnvironment& building, const Eigen::Vector3d& origin) {
  TriangleMesh mesh;
  mesh.triangles = building.triangles;
  mesh.vertices.reserve(building.vertices.size());
  for (const Eigen::Vector3d& vertex : building.vertices) {
    mesh.vertices.push_back((vertex - origin).cast<float>());
  }
  return mesh;
}

// Of the building's own triangles, then the spheres'.
TriangleMesh WithSpheres(TriangleMesh mesh, const ArtificialEnvironment& building,
                         const Eigen::Vector3d& origin) {
  int first = static_cast<int>(building.triangles.size());
  for (const EnvironmentSphere& sphere : building.spheres) {
    mesh.spheres.push_back({sphere.center - origin, sphere.radius, first});
    first += kSphereFacets;
  }
  return mesh;
}

std::vector<Eigen::Vector3d> TriangleNormals(const ArtificialEnvironment& building) {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(building.triangles.size());
  for (const Eigen::Vector3i& t : building.triangles) {
    const Eigen::Vector3d& a = building.vertices[t[0]];
    normals.push_back(
        (building.vertices[t[1]] - a).cross(building.vertices[t[2]] - a).normalized());
  }
  return normals;
}

InfluenceBox BoxAround(const TriangleMesh& mesh) {
  InfluenceBox box;
  if (mesh.vertices.empty()) return box;
  box.low = box.high = mesh.vertices[0].array();
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    box.low = box.low.min(vertex.array());
    box.high = box.high.max(vertex.array());
  }
  // Embree's robust mode may report hits this far outside.
  box.low -= 1e-3f;
  box.high += 1e-3f;
  return box;
}

std::shared_ptr<const BumpField> FieldOf(const NaturalEnvironment& natural, const Bumps& bumps,
                                         const std::string& material) {
  return std::make_shared<const BumpField>(bumps, material, natural.light.zenith_direction,
                                           natural.scene.origin);
}

SpectralMaterial NaturalSurface(const NaturalEnvironment& natural, const Polygon& polygon) {
  const auto found = natural.materials.find(polygon.material);
  if (found == natural.materials.end()) return {};
  SpectralMaterial surface{.diffuse_weight = found->second.diffuse_weight,
                           .specular = found->second.specular};
  surface.transmission = found->second.transmission;
  if (const auto& bumps = found->second.bumps) {
    surface.bumps = FieldOf(natural, *bumps, polygon.material);
  }
  return surface;
}

// Absorption by wavelength from three channels: what a layer lets through that is as thick as the
// pane, or of a body as absorbs about half.
SpectralGlass SmoothGlass(const SpectralBasis& spectra, const Glass& glass) {
  SpectralGlass result{.weight = glass.weight,
                       .is_solid = glass.is_solid,
                       .index = glass.index,
                       .thickness = glass.thickness};
  const double mean = glass.absorption_rgb.mean();
  if (mean == 0) return result;
  const double layer = glass.is_solid || glass.thickness == 0 ? 0.5 / mean : glass.thickness;
  const Eigen::Vector3d left = (-layer * glass.absorption_rgb.array()).exp();
  const Spectrum through = spectra.ReflectanceFromRgb(left).max(1e-6).min(1);
  result.absorption = -through.log() / layer;
  return result;
}

SpectralGlass GlassOf(const SpectralBasis& spectra, const Glass& glass,
                      const Roughness& roughness) {
  SpectralGlass result = SmoothGlass(spectra, glass);
  if (roughness.slope > 0) {
    result.rough = std::make_shared<const RoughSheet>(roughness, result.index, result.absorption,
                                                      result.thickness);
  }
  return result;
}

FaceSubset SubsetOf(const TriangleMesh& mesh, std::vector<int> triangles) {
  TriangleMesh part{mesh.vertices, {}};
  for (int triangle : triangles) {
    const MeshSphere* sphere = mesh.SphereOf(triangle);
    if (sphere && sphere->first_facet == triangle) {  // all its facets are of one material
      part.spheres.push_back(*sphere);
      part.spheres.back().first_facet = static_cast<int>(part.triangles.size());
    }
    part.triangles.push_back(mesh.triangles[triangle]);
  }
  RayScene rays(part);
  return {std::move(part), std::move(rays), std::move(triangles)};
}

std::optional<SplitFaces> SplitByGlass(const MontageScene& scene) {
  std::vector<int> opaque, clear;
  for (int t = 0; t < std::ssize(scene.material_of_triangle); ++t) {
    (scene.MaterialOfTriangle(t).glass ? clear : opaque).push_back(t);
  }
  if (clear.empty()) return std::nullopt;
  return SplitFaces{SubsetOf(scene.artificial_mesh, std::move(opaque)),
                    SubsetOf(scene.artificial_mesh, std::move(clear))};
}

// The lamp's own spectrum has its shape, its intensity the luminance.
Spectrum LampIntensity(const SpectralBasis& spectra, const PointLight& lamp) {
  const Spectrum from_rgb = spectra.SpectrumFromRgb(lamp.intensity_rgb);
  if (lamp.spectrum.empty() || lamp.intensity_rgb.maxCoeff() <= 0) return from_rgb;
  const Spectrum shape = Sampled(lamp.spectrum, spectra.bins());
  const double luminance = Tristimulus(from_rgb, spectra.bins()).y();
  return shape * (luminance / Tristimulus(shape, spectra.bins()).y());
}

// One that is off is not there.
void AddLamp(const PointLight& lamp, MontageScene* scene) {
  const Spectrum intensity = LampIntensity(scene->natural.spectra, lamp);
  if ((intensity <= 0).all()) return;
  const Eigen::Vector3d position = lamp.position - scene->natural.scene.origin;
  const double area = lamp.edge_u.cross(lamp.edge_v).norm();
  scene->lamps.push_back(
      {position, intensity, lamp.distribution, lamp.radius, lamp.is_visible && area == 0});
  if (area == 0 || !lamp.is_visible) return;
  scene->panels.push_back(
      {position - (lamp.edge_u + lamp.edge_v) / 2, lamp.edge_u, lamp.edge_v, intensity / area});
}

}  // namespace

double PixelAngle(const NaturalEnvironment& natural) {
  double smallest = 1;
  for (const InputImage& image : natural.input_images) {
    const Eigen::Vector2d center(image.camera.width() / 2.0, image.camera.height() / 2.0);
    const Eigen::Vector3d here = image.camera.Unproject(center).normalized();
    const Eigen::Vector3d next =
        image.camera.Unproject(center + Eigen::Vector2d::UnitX()).normalized();
    smallest = std::min(smallest, (next - here).norm());
  }
  return smallest;
}

SpectralMaterial SpectralMaterialOf(const SpectralBasis& spectra, const SurfaceMaterial& material) {
  const Spectrum albedo = material.reflectance.empty()
                              ? spectra.ReflectanceFromRgb(material.diffuse_rgb)
                              : Sampled(material.reflectance, spectra.bins());
  SpectralMaterial surface{.diffuse_weight = material.diffuse_weight,
                           .brdf = albedo / std::numbers::pi,
                           .specular = material.specular,
                           .mirror_color = spectra.ReflectanceFromRgb(material.specular_rgb)};
  const Spectrum through = material.translucent.empty()
                               ? spectra.ReflectanceFromRgb(material.translucent_rgb)
                               : Sampled(material.translucent, spectra.bins());
  surface.translucence = through / std::numbers::pi;
  for (const SurfaceMap& map : material.maps) {
    if (map.kind == SurfaceMap::Kind::kMetallic) surface.metal_share = map.mean;
  }
  if (material.metal) {
    surface.metal = SpectralMetal{Sampled(material.metal->index, spectra.bins()),
                                  Sampled(material.metal->extinction, spectra.bins())};
  }
  if (material.glass) {
    const Roughness smooth;
    surface.glass = GlassOf(spectra, *material.glass,
                            material.specular ? material.specular->roughness : smooth);
  }
  return surface;
}

MontageScene SceneWithoutImages(NaturalEnvironment natural,
                                const ArtificialEnvironment& artificial) {
  const Eigen::Vector3d origin = natural.scene.origin;
  PolygonMesh polygons = MeshOfPolygons(natural.scene);
  std::optional<ArtificialEnvironment> with_facets;  // a large mesh is copied for spheres alone
  if (!artificial.spheres.empty()) with_facets = Faceted(artificial, kSphereLevel);
  const ArtificialEnvironment& faceted = with_facets ? *with_facets : artificial;
  TriangleMesh building = WithSpheres(LocalMesh(faceted, origin), artificial, origin);
  RayScene natural_rays(polygons.mesh), artificial_rays(building);
  const InfluenceBox box = BoxAround(building);
  MontageScene scene{.natural = std::move(natural),
                     .natural_mesh = std::move(polygons.mesh),
                     .natural_rays = std::move(natural_rays),
                     .polygon_of_triangle = std::move(polygons.polygon_of_triangle),
                     .material_of_polygon = {},
                     .ground = {},
                     .artificial_mesh = std::move(building),
                     .artificial_rays = std::move(artificial_rays),
                     .artificial_normals = TriangleNormals(faceted),
                     .material_of_triangle = faceted.material_of_triangle,
                     .artificial_materials = {},
                     .split_faces = {},
                     .building_box = box,
                     .lamps = {},
                     .panels = {},
                     .sky = {},
                     .facets = {},
                     .facet_directions = {},
                     .inverse_facet_directions = {},
                     .solar_disc_radius = 0,
                     .input_images = {},
                     .images = {},
                     .mean_brdf_of_polygon = {},
                     .interreflected = {}};
  const NaturalEnvironment& site = scene.natural;
  scene.ground = LargestLevelPolygon(site.scene);
  scene.ray_angle = PixelAngle(site) / 2;
  for (const Polygon& polygon : site.scene.polygons) {
    scene.material_of_polygon.push_back(NaturalSurface(site, polygon));
  }
  for (const SurfaceMaterial& material : artificial.materials) {
    scene.artificial_materials.push_back(SpectralMaterialOf(site.spectra, material));
    if (!material.bumps || material.glass) continue;
    scene.artificial_materials.back().bumps = FieldOf(site, *material.bumps, material.name);
  }
  scene.split_faces = SplitByGlass(scene);
  for (const PointLight& lamp : artificial.lights) {
    AddLamp(lamp, &scene);
  }
  scene.sky = site.light.Sky();
  scene.facets = MakeSkyFacets(site.light.zenith_direction, site.light.polar_facets);
  INSITU_CHECK(scene.facets.directions.size() <= kMostFacets);
  for (const Eigen::Vector3d& direction : scene.facets.directions) {
    scene.facet_directions.push_back(direction.cast<float>());
    scene.inverse_facet_directions.push_back(direction.cast<float>().array().inverse());
  }
  // A cone of half angle a holds 2 pi (1 - cos a) steradians.
  const double disc = site.light.sun_is_one_direction ? 0 : site.light.sun_solid_angle;
  const double cosine = 1 - disc / (2 * std::numbers::pi);
  scene.solar_disc_radius = std::sqrt(1 - cosine * cosine) / cosine;
  return scene;
}

void SetInputImages(const std::vector<LocalImage::ImageFunction>& images, MontageScene* scene) {
  const NaturalEnvironment& natural = scene->natural;
  INSITU_CHECK(images.size() == natural.scene.cameras.size());
  INSITU_CHECK(natural.input_images.size() == images.size());
  for (size_t i = 0; i < images.size(); ++i) {
    PosedCamera camera = natural.scene.cameras[i];
    camera.camera = natural.input_images[i].camera;
    scene->images.emplace_back(camera, natural.scene.origin, images[i]);
  }
}

void SetInputImages(std::vector<Raster> images, MontageScene* scene) {
  std::vector<LocalImage::ImageFunction> functions;
  for (const Raster& image : images) {
    functions.emplace_back(
        [&image](const Eigen::Vector2d& pixel) { return Interpolate(image, pixel); });
  }
  SetInputImages(functions, scene);
  scene->input_images = std::move(images);  // which stay where they are
}

MontageScene MakeMontageScene(NaturalEnvironment natural, const ArtificialEnvironment& artificial,
                              std::vector<Raster> images) {
  MontageScene scene = SceneWithoutImages(std::move(natural), artificial);
  SetInputImages(std::move(images), &scene);
  scene.mean_brdf_of_polygon = MeanBrdfOfPolygons(scene);
  return scene;
}

}  // namespace insitu
