// SPDX-License-Identifier: GPL-3.0-or-later
// What a ray meets first: the building, the site, the ground beyond it, a lamp.
#pragma once

#include <optional>

#include "renderer/trace/montage_scene.h"

namespace insitu {

enum class World { kSiteOnly, kWithBuilding };

struct SceneHit {
  bool is_building = false;
  int index = 0;  // triangle of the building, or polygon of the site
  double distance = 0;
  SurfacePoint surface;                 // normal on the side the ray comes from
  std::optional<FacePlace> place = {};  // nullopt: on the ground beyond its polygon
};

std::optional<SceneHit> FindHit(const MontageScene& scene, Ray ray, World world);

// Where a ray that meets no object goes below the horizon: onto the plane of the ground, which is
// taken to go on beyond its polygon. nullopt: above the horizon, or no ground to go on.
std::optional<SceneHit> FindGround(const MontageScene& scene, const Ray& ray);

// The luminous surface of a lamp, where a ray meets one up to its far end.
struct LampHit {
  double distance = 0;  // [m]
  Spectrum radiance;
};
std::optional<LampHit> FindLamp(const MontageScene& scene, const Ray& ray);

// Light of sky and surroundings where a ray meets a surface; nullopt: the paper's.
std::optional<SmoothLight> LightAround(const MontageScene& scene, const SceneHit& hit);
// The same of the other side of the building's face.
std::optional<SmoothLight> LightBehind(const MontageScene& scene, const SceneHit& hit);
// What that is made of; all zero with the paper's.
GatheredParts PartsAround(const MontageScene& scene, const SceneHit& hit);

}  // namespace insitu
