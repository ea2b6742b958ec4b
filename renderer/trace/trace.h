// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of [Durisch92, §6.2]: what one ray of the current camera brings.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "renderer/trace/light_split.h"
#include "renderer/trace/montage_scene.h"
#include "renderer/trace/scene_hit.h"

namespace insitu {

// A primary ray with what the photograph shows there.
struct PrimaryRay {
  Ray ray;                       // local frame, from the centre of projection
  Eigen::Vector3d apparent_rgb;  // the current photograph's pixel, linear
  LightDirections light;
};

struct RayOutcome {
  bool hits_building = false;
  // hits_building: the radiance, linear RGB. Otherwise the change to the photograph's pixel;
  // exactly zero where the building has no influence.
  Eigen::Vector3d rgb = Eigen::Vector3d::Zero();
};

// Whether the building is the first that a ray of the current camera meets.
bool HitsBuilding(const MontageScene& scene, const Ray& ray);

// Cases A (no object: no change), C (the building) and D (the site: D1, D2, D3).
RayOutcome TracePrimary(const MontageScene& scene, const PrimaryRay& primary);

// Apparent radiance along a secondary ray: cases B, C and D. `depth` counts the mirrors and panes
// before it; beyond kMaxMirrors the horizon colour is returned.
constexpr int kMaxMirrors = 8;
Spectrum TraceSecondary(const MontageScene& scene, const Ray& ray, const LightDirections& light,
                        World world, int depth);

// Case C: true colour of the building at a point, looked at from `to_viewer` (unit). `around` is
// the light of sky and surroundings there, `behind` that of its other side, from where it may be
// translucent; nullopt: the paper's.
Spectrum BuildingColor(const MontageScene& scene, const SurfacePoint& surface,
                       const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                       const LightDirections& light, int depth,
                       const std::optional<SmoothLight>& around = std::nullopt,
                       const std::optional<SmoothLight>& behind = std::nullopt);

// Cases D1 and D3: the change of a diffuse natural surface of true colour L_0 by the lamps' light
// that comes and the daylight that the building cuts off, the latter as a negative irradiance.
// D2 is its being zero. Never below -L_0. `diffuse_weight` is k_d. `around` is the light of sky and
// surroundings, whose change counts with its sign; nullopt: the paper's, and the change is at most
// 0 without lamps.
Spectrum DiffuseChange(const MontageScene& scene, const SurfacePoint& surface,
                       const Spectrum& true_color, double diffuse_weight,
                       const LightDirections& light,
                       const std::optional<SmoothLight>& around = std::nullopt);

}  // namespace insitu
