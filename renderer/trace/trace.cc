// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/trace.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "radiometry/light/illumination.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/profile.h"
#include "renderer/trace/surface_textures.h"

namespace insitu {
namespace {

// The building's faces win over polygons that survey noise leaves just before them.
constexpr double kPi = std::numbers::pi;
constexpr double kCoincidence = 0.01;  // [m]

struct SceneHit {
  bool is_building = false;
  int index = 0;  // triangle of the building, or polygon of the site
  double distance = 0;
  SurfacePoint surface;                 // normal on the side the ray comes from
  std::optional<FacePlace> place = {};  // nullopt: on the ground beyond its polygon
};

SurfacePoint Facing(const Ray& ray, double distance, const Eigen::Vector3d& normal) {
  const double side = ray.direction.dot(normal) <= 0 ? 1 : -1;
  return {ray.origin + distance * ray.direction, side * normal};
}

std::optional<SceneHit> FindHit(const MontageScene& scene, Ray ray, World world) {
  const PhaseScope phase(Phase::kEmbree);
  std::optional<SceneHit> found;
  if (world == World::kWithBuilding) {
    if (const auto hit = scene.artificial_rays.Nearest(ray)) {
      const Eigen::Vector3d& normal = scene.artificial_normals[hit->triangle];
      found = SceneHit{true, hit->triangle, hit->distance, Facing(ray, hit->distance, normal),
                       FacePlace{hit->triangle, hit->uv, ray.direction.dot(normal) > 0}};
      ray.far = hit->distance - kCoincidence;
    }
  }
  if (const auto hit = scene.natural_rays.Nearest(ray)) {
    const int polygon = scene.polygon_of_triangle[hit->triangle];
    const Eigen::Vector3d& normal = scene.natural.scene.polygons[polygon].normal;
    found = SceneHit{false, polygon, hit->distance, Facing(ray, hit->distance, normal),
                     FacePlace{hit->triangle, hit->uv, ray.direction.dot(normal) > 0}};
  }
  return found;
}

// Where a ray that meets no object goes below the horizon: onto the plane of the ground, which is
// taken to go on beyond its polygon. nullopt: above the horizon, or no ground to go on.
std::optional<SceneHit> FindGround(const MontageScene& scene, const Ray& ray) {
  if (!scene.ground || ray.direction.dot(scene.natural.light.zenith_direction) >= 0) {
    return std::nullopt;
  }
  const Polygon& ground = scene.natural.scene.polygons[*scene.ground];
  const Eigen::Vector3d foot = ground.vertices[0] - scene.natural.scene.origin;
  const double distance = ground.normal.dot(foot - ray.origin) / ground.normal.dot(ray.direction);
  if (!(distance > 0)) return std::nullopt;
  return SceneHit{false, *scene.ground, distance, Facing(ray, distance, ground.normal)};
}

// Light of sky and surroundings where a ray meets a surface; nullopt: the paper's.
std::optional<SmoothLight> LightAround(const MontageScene& scene, const SceneHit& hit) {
  if (!scene.interreflected) return std::nullopt;
  if (!hit.place) return SmoothLight{};  // too far to matter
  const InterreflectedLight& light = *scene.interreflected;
  return (hit.is_building ? light.on_building : light.on_site).At(*hit.place);
}

Ray Reflected(const SurfacePoint& surface, const Eigen::Vector3d& to_viewer, double clearance) {
  const Eigen::Vector3d direction = 2 * surface.normal.dot(to_viewer) * surface.normal - to_viewer;
  return {surface.position + clearance * surface.normal, direction.normalized()};
}

double MirrorShare(const SurfacePoint& surface, const SpectralMaterial& material,
                   const Eigen::Vector3d& to_viewer) {
  return MirrorWeight(material.specular, std::min(1.0, surface.normal.dot(to_viewer)));
}

// What a natural surface mirrors towards a viewer.
Spectrum Mirrored(const MontageScene& scene, const SurfacePoint& surface,
                  const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                  const LightDirections& light, World world, int depth) {
  const double share = MirrorShare(surface, material, to_viewer);
  if (share <= 0) return Spectrum::Zero();
  const Ray ray = Reflected(surface, to_viewer, kSurveyClearance);
  return share * TraceSecondary(scene, ray, light, world, depth + 1);
}

// Case D on a primary ray: the change of the pixel. The photograph is the current one.
Eigen::Vector3d ChangeOfPixel(const MontageScene& scene, const PrimaryRay& primary,
                              const SceneHit& hit) {
  const SpectralMaterial& material = scene.material_of_polygon[hit.index];
  const SpectralBasis& spectra = scene.natural.spectra;
  const Atmosphere& air = scene.natural.air;
  const Eigen::Vector3d to_viewer = -primary.ray.direction;
  const Spectrum L0 =
      TrueColor(spectra.SpectrumFromRgb(primary.apparent_rgb), air, hit.distance).max(0);
  Spectrum change = Spectrum::Zero();
  Spectrum mirrored_before = Spectrum::Zero();
  if (material.specular) {
    mirrored_before =
        Mirrored(scene, hit.surface, material, to_viewer, primary.light, World::kSiteOnly, 0);
    change =
        Mirrored(scene, hit.surface, material, to_viewer, primary.light, World::kWithBuilding, 0) -
        mirrored_before;
  }
  change += DiffuseChange(scene, hit.surface, (L0 - mirrored_before).max(0),
                          material.diffuse_weight, primary.light, LightAround(scene, hit));
  if ((change == 0).all()) return Eigen::Vector3d::Zero();  // D2
  change = change.max(-L0) * TransmittanceOver(air, hit.distance);
  return spectra.RgbFromSpectrum(change);
}

Spectrum SunBefore(const MontageScene& scene, const SurfacePoint& surface,
                   const LightDirections& light) {
  return scene.natural.light.sun_radiance * SplitSunlight(scene, surface, light, true).natural;
}

// Case D on a secondary ray: true colour of a natural surface, from the photograph that shows it.
Spectrum SiteColor(const MontageScene& scene, const SceneHit& hit, const Eigen::Vector3d& to_viewer,
                   const LightDirections& light, World world, int depth) {
  const SpectralMaterial& material = scene.material_of_polygon[hit.index];
  const std::optional<SmoothLight> around = LightAround(scene, hit);
  Spectrum diffuse;
  if (const auto seen = LookUpColor(scene.Photographed(), hit.index, hit.surface)) {
    diffuse = (seen->true_color - Mirrored(scene, hit.surface, material, seen->to_camera, light,
                                           World::kSiteOnly, depth))
                  .max(0);
  } else if (around) {
    diffuse = ReflectedRadiance(1, scene.interreflected->interreflection.MeanBrdf(hit.index),
                                around->before + SunBefore(scene, hit.surface, light));
  } else {
    const SplitLight split = SplitDaylight(scene, hit.surface, light, true);
    diffuse = ReflectedRadiance(1, scene.mean_brdf_of_polygon[hit.index],
                                TotalIrradiance(scene.natural.light, split.natural));
  }
  Spectrum L0 = diffuse + Mirrored(scene, hit.surface, material, to_viewer, light, world, depth);
  if (world == World::kWithBuilding) {
    L0 += DiffuseChange(scene, hit.surface, diffuse, material.diffuse_weight, light, around);
  }
  return L0.max(0);
}

// D1 and D3 in one: what the building takes of sun, sky and surroundings, and what it sends.
Spectrum ChangeInBalance(const Daylight& light, const SplitSun& sun, const SmoothLight& around,
                         const Spectrum& E_lamps, const Spectrum& true_color,
                         double diffuse_weight) {
  const Spectrum E_before = light.sun_radiance * sun.natural + around.before;
  const Spectrum E_change = E_lamps + around.change - light.sun_radiance * sun.blocked;
  const Spectrum rho = DiffuseBrdf(true_color, diffuse_weight, E_before);
  // No surface sends back more than it receives, but for errors of photograph and light: they
  // must not grow where light is added.
  const Spectrum bounded = (E_change > 0).select(rho.min(1 / (diffuse_weight * kPi)), rho);
  return ReflectedRadiance(diffuse_weight, bounded, E_change).max(-true_color);
}

// What a face of the building is made of where a ray meets it.
SpectralMaterial MaterialAt(const MontageScene& scene, const SceneHit& hit,
                            const Eigen::Vector3d& to_viewer) {
  SpectralMaterial material = scene.artificial_materials[scene.material_of_triangle[hit.index]];
  if (!scene.textures) return material;
  if (const auto albedo = scene.textures->Albedo(*hit.place, hit.distance, -to_viewer)) {
    material.brdf = scene.natural.spectra.ReflectanceFromRgb(*albedo) / kPi;
  }
  return material;
}

Spectrum ColorOf(const MontageScene& scene, const SceneHit& hit, const Eigen::Vector3d& to_viewer,
                 const LightDirections& light, World world, int depth) {
  if (!hit.is_building) return SiteColor(scene, hit, to_viewer, light, world, depth);
  return BuildingColor(scene, hit.surface, MaterialAt(scene, hit, to_viewer), to_viewer, light,
                       depth, LightAround(scene, hit));
}

}  // namespace

Spectrum BuildingColor(const MontageScene& scene, const SurfacePoint& surface,
                       const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                       const LightDirections& light, int depth,
                       const std::optional<SmoothLight>& around) {
  const Daylight& daylight = scene.natural.light;
  const Spectrum E =
      LampIrradiance(scene, surface) +
      (around ? daylight.sun_radiance * SunOnBuilding(scene, surface, light) + around->before +
                    around->change
              : TotalIrradiance(daylight, DaylightOnBuilding(scene, surface, light)));
  const double mirror = MirrorShare(surface, material, to_viewer);
  Spectrum L = (1 - mirror) * ReflectedRadiance(material.diffuse_weight, material.brdf, E);
  if (mirror > 0) {
    const Ray ray = Reflected(surface, to_viewer, kBuildingClearance);
    L += mirror * TraceSecondary(scene, ray, light, World::kWithBuilding, depth + 1);
  }
  return L;
}

Spectrum DiffuseChange(const MontageScene& scene, const SurfacePoint& surface,
                       const Spectrum& true_color, double diffuse_weight,
                       const LightDirections& light, const std::optional<SmoothLight>& around) {
  const Spectrum E_lamps =
      scene.lamps.empty() ? Spectrum::Zero().eval() : LampIrradiance(scene, surface);
  const bool lit = (E_lamps > 0).any();
  if (around) {
    const SplitSun sun = SplitSunlight(scene, surface, light, lit || around->matters);
    if (!lit && !around->matters && sun.blocked == 0) return Spectrum::Zero();  // D2
    return ChangeInBalance(scene.natural.light, sun, *around, E_lamps, true_color, diffuse_weight);
  }
  const SplitLight split = SplitDaylight(scene, surface, light, lit);
  if (!lit && !split.IsChanged()) return Spectrum::Zero();  // D2
  const Daylight& daylight = scene.natural.light;
  const Spectrum E_natural = TotalIrradiance(daylight, split.natural);
  const Spectrum E_blocked =
      SunIrradiance(daylight, split.blocked) + SkyIrradiance(daylight, split.blocked);
  const Spectrum rho = DiffuseBrdf(true_color, diffuse_weight, E_natural);
  const Spectrum removed = ReflectedRadiance(diffuse_weight, rho, -E_blocked);  // D3
  const Spectrum added = ReflectedRadiance(diffuse_weight, rho, E_lamps);       // D1
  return removed.max(-true_color) + added;
}

Spectrum TraceSecondary(const MontageScene& scene, const Ray& ray, const LightDirections& light,
                        World world, int depth) {
  const Atmosphere& air = scene.natural.air;
  if (depth > kMaxMirrors) return air.horizon;
  auto hit = FindHit(scene, ray, world);
  // Case B. Departure: the paper leaves open what a ray below the horizon returns.
  if (!hit) hit = FindGround(scene, ray);
  if (!hit) return air.horizon;
  const Spectrum L0 = ColorOf(scene, *hit, -ray.direction, light, world, depth);
  return ApparentColor(L0, air, hit->distance);
}

bool HitsBuilding(const MontageScene& scene, const Ray& ray) {
  const Eigen::Array3f inverse = ray.direction.cast<float>().array().inverse();
  if (!scene.building_box.MayMeet(ray.origin.cast<float>().array(), inverse)) return false;
  const auto hit = FindHit(scene, ray, World::kWithBuilding);
  return hit && hit->is_building;
}

RayOutcome TracePrimary(const MontageScene& scene, const PrimaryRay& primary) {
  const auto hit = FindHit(scene, primary.ray, World::kWithBuilding);
  if (!hit) return {};  // case A
  if (!hit->is_building) return {false, ChangeOfPixel(scene, primary, *hit)};
  const Spectrum L0 =
      ColorOf(scene, *hit, -primary.ray.direction, primary.light, World::kWithBuilding, 0);
  const Spectrum L = ApparentColor(L0, scene.natural.air, hit->distance);
  return {true, scene.natural.spectra.RgbFromSpectrum(L)};
}

}  // namespace insitu
