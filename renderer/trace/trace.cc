// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/trace.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "radiometry/light/illumination.h"
#include "radiometry/light/mirrored_share.h"
#include "radiometry/light/split_mix.h"
#include "renderer/trace/glass.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/mirror.h"
#include "renderer/trace/sampling.h"
#include "renderer/trace/surface_textures.h"

namespace insitu {
namespace {

double CosineTo(const SurfacePoint& surface, const Eigen::Vector3d& to_viewer) {
  return std::min(1.0, surface.normal.dot(to_viewer));
}

// The mirror image in a surface towards a viewer, sun and lamps in it included, as if it mirrored
// all.
Spectrum MirrorImage(const MontageScene& scene, const SurfacePoint& surface,
                     const Roughness& roughness, const Eigen::Vector3d& to_viewer,
                     const LightDirections& light, World world, int depth, double clearance) {
  // As printed the mirror image is sharp, however rough the surface. [Hall & Greenberg 1983]
  const bool is_rough = roughness.slope > 0;
  const Roughness of_rays = scene.as_printed ? Roughness{} : roughness;
  // Behind a first mirror one facet is enough.
  const int facets = of_rays.slope > 0 && depth == 0 ? kFacetsPerRay : 1;
  Spectrum image = Spectrum::Zero();
  for (int i = 0; i < facets; ++i) {
    const MirroredRay mirrored = ChooseMirrored(surface, of_rays, to_viewer, clearance,
                                                SpreadAfter(FacetChoice(light, depth), i));
    if (mirrored.weight <= 0) continue;
    LightDirections further = light;
    further.sees_lights = light.sees_lights && !is_rough;
    further.share = light.share / facets;
    if (i > 0) further.seed = SplitMix64(light.seed + i);
    image += mirrored.weight * TraceSecondary(scene, mirrored.ray, further, world, depth + 1);
  }
  return image / facets + LightsInRoughMirror(scene, surface, roughness, to_viewer, light,
                                              world == World::kWithBuilding, clearance);
}

// What a natural surface mirrors towards a viewer.
Spectrum Mirrored(const MontageScene& scene, const SurfacePoint& surface,
                  const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                  const LightDirections& light, World world, int depth) {
  const Spectrum share = MirrorReflectance(material, CosineTo(surface, to_viewer));
  if ((share <= 0).all()) return Spectrum::Zero();
  return share * MirrorImage(scene, surface, material.specular->roughness, to_viewer,
                             Part(light, scene, share), world, depth, kSurveyClearance);
}

// What of a natural surface's radiance towards a camera is mirrored, before the building stands. A
// rough mirror counts as what it is on the mean, a smooth one: what is left, which is not below
// zero, would grow with the scatter of single facets.
Spectrum MirroredBefore(const MontageScene& scene, const SurfacePoint& surface,
                        const SpectralMaterial& material, const Eigen::Vector3d& to_camera,
                        const LightDirections& light, int depth) {
  if (!material.specular || material.specular->roughness.slope == 0) {
    return Mirrored(scene, surface, material, to_camera, light, World::kSiteOnly, depth);
  }
  LightDirections without_lights = light;
  without_lights.sees_lights = false;
  const Spectrum image = MirrorImage(scene, surface, {}, to_camera, without_lights,
                                     World::kSiteOnly, depth, kSurveyClearance) +
                         LightsInRoughMirror(scene, surface, material.specular->roughness,
                                             to_camera, light, false, kSurveyClearance);
  return MirrorReflectance(material, CosineTo(surface, to_camera)) * image;
}

// What the building's diffuse part returns of each light; `share` of it is not mirrored.
void NoteDiffuse(const MontageScene& scene, const SurfacePoint& surface,
                 const SpectralMaterial& material, const LightDirections& light,
                 const std::optional<SmoothLight>& around, const Spectrum& share) {
  const Daylight& daylight = scene.natural.light;
  const auto note = [&](LightPart part, const Spectrum& irradiance) {
    light.parts->light[part] +=
        share * ReflectedRadiance(material.diffuse_weight, material.brdf, irradiance);
  };
  note(kBuildingLamps, LampIrradiance(scene, surface, light));
  if (around) {
    note(kBuildingSun, daylight.sun_radiance * SunOnBuilding(scene, surface, light));
    note(kBuildingSky, light.parts->around.sky);
    return note(kBuildingSurroundings, light.parts->around.surroundings);
  }
  const LightGeometry geometry = DaylightOnBuilding(scene, surface, light);
  note(kBuildingSun, SunIrradiance(daylight, geometry));
  note(kBuildingSky, SkyIrradiance(daylight, geometry));
  note(kBuildingSurroundings, AmbientIrradiance(daylight, geometry));
}

// What a camera ray meets, and what its parts lose on their way through the air.
void NoteHit(const SceneHit& hit, const MontageScene& scene, RayParts* parts) {
  parts->has_hit = true;
  parts->hit = {.is_building = hit.is_building,
                .polygon = hit.is_building ? -1 : hit.index,
                .material = hit.is_building ? scene.material_of_triangle[hit.index] : -1,
                .distance = hit.distance,
                .normal = hit.surface.normal};
  parts->around = PartsAround(scene, hit);
}
void NoteAir(const Atmosphere& air, double distance, RayParts* parts) {
  for (Spectrum& light : parts->light) light *= TransmittanceOver(air, distance);
}

// Case D on a primary ray: the change of the pixel. The photograph is the current one.
Eigen::Vector3d ChangeOfPixel(const MontageScene& scene, const PrimaryRay& primary,
                              const SceneHit& hit) {
  const SpectralMaterial& material = scene.material_of_polygon[hit.index];
  const SpectralBasis& spectra = scene.natural.spectra;
  const Atmosphere& air = scene.natural.air;
  const Eigen::Vector3d to_viewer = -primary.ray.direction;
  const auto balance = BalanceAt(scene, hit.surface, primary.light, LightAround(scene, hit));
  if (!balance && !material.specular) return Eigen::Vector3d::Zero();  // D2, most of a photograph
  const Spectrum L0 =
      TrueColor(spectra.SpectrumFromRgb(primary.apparent_rgb), air, hit.distance).max(0);
  Spectrum change = Spectrum::Zero();
  Spectrum mirrored_before = Spectrum::Zero();
  if (material.specular) {
    mirrored_before = MirroredBefore(scene, hit.surface, material, to_viewer, primary.light, 0);
    const BumpedSurface bumped = BumpedAt(scene, hit.surface, material, to_viewer, hit.distance);
    const auto mirrored = [&](World world) {
      return Mirrored(scene, bumped.surface, bumped.material, to_viewer, primary.light, world, 0);
    };
    const bool is_even = material.specular->roughness.slope == 0 && !material.bumps;
    change =
        mirrored(World::kWithBuilding) - (is_even ? mirrored_before : mirrored(World::kSiteOnly));
    if (primary.light.parts) primary.light.parts->light[kChangeReflection] = change;
  }
  if (balance) {
    const Spectrum diffuse = (1 - material.transmission) * (L0 - mirrored_before).max(0);
    if (primary.light.parts) {
      NoteChange(*balance, diffuse, material.diffuse_weight, primary.light.parts);
    }
    change += ChangeBy(*balance, diffuse, material.diffuse_weight);
  }
  if ((change == 0).all()) return Eigen::Vector3d::Zero();  // D2
  change = change.max(-L0) * TransmittanceOver(air, hit.distance);
  return spectra.RgbFromSpectrum(change);
}

// Apparent radiance at the camera of what a primary ray shows beyond a distance: the photograph's
// pixel where the site comes next, unchanged but for what the building does there.
Spectrum ApparentBeyond(const MontageScene& scene, PrimaryRay primary, double beyond) {
  primary.ray.near = beyond + kBuildingClearance;
  primary.light.parts = nullptr;
  const RayOutcome outcome = TracePrimary(scene, primary);
  const SpectralBasis& spectra = scene.natural.spectra;
  if (outcome.hits_building) return spectra.SpectrumFromRgb(outcome.rgb);
  return spectra.SpectrumFromRgb(primary.apparent_rgb + outcome.rgb);
}

Spectrum SunBefore(const MontageScene& scene, const SurfacePoint& surface,
                   const LightDirections& light) {
  return scene.natural.light.sun_radiance * SplitSunlight(scene, surface, light, true).natural;
}

// Case D on a secondary ray: true colour of a natural surface, from the photographs that show it.
Spectrum SiteColor(const MontageScene& scene, const SceneHit& hit, const Eigen::Vector3d& to_viewer,
                   LightDirections light, World world, int depth) {
  light.sun_share = 1;  // that of the surface that the camera ray met
  const SpectralMaterial& material = scene.material_of_polygon[hit.index];
  const std::optional<SmoothLight> around = LightAround(scene, hit);
  Spectrum diffuse = Spectrum::Zero();
  const auto seen = LookUpColors(scene.Photographed(), hit.index, hit.surface);
  for (const PhotographedColor& color : seen) {
    const Spectrum mirrored =
        MirroredBefore(scene, hit.surface, material, color.to_camera, light, depth);
    diffuse += color.weight * (color.true_color - mirrored).max(0);
  }
  const bool is_unseen = seen.empty();
  if (is_unseen && light.unseen && world == World::kWithBuilding) *light.unseen += light.share;
  if (is_unseen && around) {
    diffuse = ReflectedRadiance(1, scene.interreflected->interreflection.MeanBrdf(hit.index),
                                around->before + SunBefore(scene, hit.surface, light));
  } else if (is_unseen) {
    const SplitLight split = SplitDaylight(scene, hit.surface, light, true);
    diffuse = ReflectedRadiance(1, scene.mean_brdf_of_polygon[hit.index],
                                TotalIrradiance(scene.natural.light, split.natural));
  }
  const BumpedSurface bumped = BumpedAt(scene, hit.surface, material, to_viewer, hit.distance);
  Spectrum L0 =
      diffuse + Mirrored(scene, bumped.surface, bumped.material, to_viewer, light, world, depth);
  if (world == World::kWithBuilding) {
    L0 += DiffuseChange(scene, hit.surface, (1 - material.transmission) * diffuse,
                        material.diffuse_weight, light, around);
  }
  return L0.max(0);
}

// On a face of the building.
Spectrum IrradianceOfBuilding(const MontageScene& scene, const SurfacePoint& surface,
                              const LightDirections& light,
                              const std::optional<SmoothLight>& around) {
  const Daylight& daylight = scene.natural.light;
  return LampIrradiance(scene, surface, light) +
         (around ? daylight.sun_radiance * SunOnBuilding(scene, surface, light) + around->before +
                       around->change
                 : TotalIrradiance(daylight, DaylightOnBuilding(scene, surface, light)));
}

// The colour of a face of the building. `straight_on` is what is seen through it if it is a pane.
Spectrum FaceColor(const MontageScene& scene, const SceneHit& hit, const Ray& ray,
                   const LightDirections& light, int depth,
                   const std::function<Spectrum()>& straight_on) {
  const auto [surface, material] = BuildingSurfaceAt(scene, hit.surface, *hit.place, hit.distance,
                                                     -ray.direction, PathChoice(light, depth));
  if (!material.glass) {
    return BuildingColor(scene, surface, material, -ray.direction, light, depth,
                         LightAround(scene, hit),
                         material.IsTranslucent() ? LightBehind(scene, hit) : std::nullopt);
  }
  const auto trace = [&](const Ray& further, const LightDirections& of) {
    return TraceSecondary(scene, further, of, World::kWithBuilding, depth + 1);
  };
  const Spectrum glass = GlassColor(scene, hit, material, ray, light, depth, straight_on, trace);
  if (material.glass->weight >= 1) return glass;
  SpectralMaterial ground = material;  // what is neither mirrored nor goes through
  ground.specular.reset();
  const Spectrum share = (1 - material.glass->weight) *
                         (1 - GlassReflectance(material, CosineTo(hit.surface, -ray.direction)));
  const Spectrum matte = BuildingColor(scene, hit.surface, ground, -ray.direction, light, depth,
                                       LightAround(scene, hit));
  if (light.parts && depth == 0) {
    for (const LightPart part :
         {kBuildingSun, kBuildingSky, kBuildingSurroundings, kBuildingLamps}) {
      light.parts->light[part] *= share;
    }
  }
  return glass + share * matte;
}

// Case B above the horizon: the horizon's colour, or what the photographs show of the sky there.
Spectrum SkyColor(const MontageScene& scene, const Eigen::Vector3d& direction) {
  const Daylight& light = scene.natural.light;
  if (!light.photographed_sky || light.zenith_direction.dot(direction) <= 0) {
    return scene.natural.air.horizon;
  }
  return *light.photographed_sky * scene.sky.Towards(direction);
}

}  // namespace

Spectrum BuildingColor(const MontageScene& scene, const SurfacePoint& surface,
                       const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                       const LightDirections& light, int depth,
                       const std::optional<SmoothLight>& around,
                       const std::optional<SmoothLight>& behind) {
  const Spectrum E = IrradianceOfBuilding(scene, surface, light, around);
  const double cosine = CosineTo(surface, to_viewer);
  const Spectrum mirror = MirrorReflectance(material, cosine);
  Spectrum diffuse_share = Spectrum::Ones(), mirror_share = mirror;  // as printed
  if (!scene.as_printed && (mirror > 0).any()) {
    // What meets a second facet is mirrored again or goes on to the ground: all of it in the shape
    // of a first reflection. [Turquin 2019]
    const double single = MirroredShare(material.specular->roughness, cosine);
    const Spectrum again = (1 - single) * mirror;
    diffuse_share = (1 - mirror) * (1 + again);
    mirror_share = mirror * (1 + again / single);
  }
  const bool is_noted = light.parts && depth == 0;
  if (is_noted) NoteDiffuse(scene, surface, material, light, around, diffuse_share);
  Spectrum diffuse = diffuse_share * ReflectedRadiance(material.diffuse_weight, material.brdf, E);
  if (material.IsTranslucent()) {
    const SurfacePoint other{surface.position, -surface.normal};
    const Spectrum through =
        diffuse_share * material.translucence * IrradianceOfBuilding(scene, other, light, behind);
    if (is_noted) light.parts->light[kBuildingTransmission] += through;
    diffuse += through;
  }
  if ((mirror <= 0).all()) return diffuse;
  const Spectrum image = MirrorImage(scene, surface, material.specular->roughness, to_viewer,
                                     Part(light, scene, mirror_share), World::kWithBuilding, depth,
                                     kBuildingClearance);
  if (is_noted) light.parts->light[kBuildingReflection] += mirror_share * image;
  return diffuse + mirror_share * image;
}

Spectrum DiffuseChange(const MontageScene& scene, const SurfacePoint& surface,
                       const Spectrum& true_color, double diffuse_weight,
                       const LightDirections& light, const std::optional<SmoothLight>& around) {
  const auto balance = BalanceAt(scene, surface, light, around);
  return balance ? ChangeBy(*balance, true_color, diffuse_weight) : Spectrum::Zero();
}

Spectrum TraceSecondary(const MontageScene& scene, const Ray& ray, const LightDirections& light,
                        World world, int depth) {
  if (light.parts) {  // what it brings counts as a whole
    LightDirections alone = light;
    alone.parts = nullptr;
    return TraceSecondary(scene, ray, alone, world, depth);
  }
  const Atmosphere& air = scene.natural.air;
  if (depth > kMaxMirrors) return air.horizon;
  auto hit = FindHit(scene, ray, world);
  if (light.sees_lights && world == World::kWithBuilding) {
    Ray to_lamp = ray;
    if (hit) to_lamp.far = hit->distance;
    if (const auto lamp = FindLamp(scene, to_lamp)) {
      return ApparentColor(lamp->radiance, air, lamp->distance);
    }
  }
  // Case B. Departure: the paper leaves open what a ray below the horizon returns.
  if (!hit && !scene.as_printed) hit = FindGround(scene, ray);
  if (!hit) {
    const Spectrum sky = SkyColor(scene, ray.direction);
    return light.sees_lights ? Spectrum(sky + SunAlong(scene, ray.direction)) : sky;
  }
  if (!hit->is_building) {
    return ApparentColor(SiteColor(scene, *hit, -ray.direction, light, world, depth), air,
                         hit->distance);
  }
  const auto straight_on = [&] {
    const Ray rest = {hit->surface.position + kBuildingClearance * ray.direction, ray.direction};
    return TraceSecondary(scene, rest, light, world, depth + 1);
  };
  return ApparentColor(FaceColor(scene, *hit, ray, light, depth, straight_on), air, hit->distance);
}

bool HitsBuilding(const MontageScene& scene, const Ray& ray) {
  const Eigen::Array3f inverse = ray.direction.cast<float>().array().inverse();
  if (!scene.building_box.MayMeet(ray.origin.cast<float>().array(), inverse)) return false;
  const auto hit = FindHit(scene, ray, World::kWithBuilding);
  return hit && hit->is_building;
}

RayOutcome TracePrimary(const MontageScene& scene, const PrimaryRay& primary) {
  const auto hit = FindHit(scene, primary.ray, World::kWithBuilding);
  const Atmosphere& air = scene.natural.air;
  Ray to_lamp = primary.ray;
  if (hit) to_lamp.far = hit->distance;
  RayParts* const parts = primary.light.parts;
  if (const auto lamp = FindLamp(scene, to_lamp)) {
    const Spectrum shown = ApparentColor(lamp->radiance, air, lamp->distance);
    if (parts) parts->light[kBuildingLamps] = shown;
    return {true, scene.natural.spectra.RgbFromSpectrum(shown)};
  }
  if (!hit) return {};  // case A
  if (parts) NoteHit(*hit, scene, parts);
  if (!hit->is_building) {
    const Eigen::Vector3d change = ChangeOfPixel(scene, primary, *hit);
    if (parts) NoteAir(air, hit->distance, parts);
    return {false, change};
  }
  const auto straight_on = [&] {
    return TrueColor(ApparentBeyond(scene, primary, hit->distance), air, hit->distance);
  };
  const Spectrum L0 = FaceColor(scene, *hit, primary.ray, primary.light, 0, straight_on);
  if (parts) {
    NoteAir(air, hit->distance, parts);
    parts->light[kBuildingHaze] = ApparentColor(Spectrum::Zero(), air, hit->distance);
  }
  return {true, scene.natural.spectra.RgbFromSpectrum(ApparentColor(L0, air, hit->distance))};
}

}  // namespace insitu
