// SPDX-License-Identifier: GPL-3.0-or-later
// Which part of the daylight reaches a point, which part of it the building cuts off, and what of a
// camera ray's radiance each makes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "radiometry/light/daylight.h"
#include "renderer/trace/irradiance_map.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// Of the building, its light by where it comes from, and haze before it; of the site, its change by
// cause.
enum LightPart {
  kBuildingSun,
  kBuildingSky,
  kBuildingSurroundings,  // site and other faces of the building
  kBuildingLamps,
  kBuildingReflection,    // what its surfaces and glass mirror
  kBuildingTransmission,  // what its glass lets through
  kBuildingHaze,
  kSunBlocked,  // what the building keeps away: negative
  kSkyBlocked,
  kSurroundingsBlocked,
  kBounced,  // what the building sends, and what it changes of what the site sends
  kChangeLamps,
  kChangeReflection,
  kLightParts
};

// What a ray of the camera meets first.
struct FirstHit {
  bool is_building = false;
  int polygon = -1;   // of the site
  int material = -1;  // of the building
  double distance = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, world, on the side of the camera
};

// Of one ray. Where it meets nothing there is no hit, and every part is zero.
struct RayParts {
  RayParts() { light.fill(Spectrum::Zero()); }
  std::array<Spectrum, kLightParts> light;  // as they reach the camera
  bool has_hit = false;
  FirstHit hit;
  GatheredParts around;  // where it is, with light among surfaces
};

// The light directions of one camera ray: a point of the sun's disc and every `stride`-th sky facet
// from `first`. Four rays a pixel with stride 4 together use every facet once.
// What else goes with the ray: the first facet of its first mirror, by the seed all further
// choices, and whether it may still meet sun and lamps themselves: not behind a rough mirror, where
// they are counted apart.
struct LightDirections {
  Eigen::Vector3d sun;  // unit; any point of the disc
  int first = 0;
  int stride = 1;
  Eigen::Vector2d facet = Eigen::Vector2d::Constant(0.5);  // [0, 1)^2
  uint64_t seed = 0;
  bool sees_lights = true;
  // Of the sun that no polygon keeps from the surface that a camera ray meets, what the photograph
  // shows to arrive, 0..1.
  double sun_share = 1;
  // Of what the camera ray brings, about how much this ray's radiance counts, 0..1; that is added
  // to `unseen` where no photograph shows what it meets. nullptr: nobody asks.
  double share = 1;
  double* unseen = nullptr;
  // Receives what a camera ray's radiance is made of; nullptr: nobody asks.
  RayParts* parts = nullptr;
};

// `disc` and `facet` are uniform in [0, 1)^2; `ray` counts the rays of a pixel.
LightDirections ChooseLightDirections(const MontageScene& scene, const Eigen::Vector2d& disc,
                                      int ray,
                                      const Eigen::Vector2d& facet = Eigen::Vector2d::Constant(0.5),
                                      uint64_t seed = 0);

// Light at a point of the existing site. `natural` is what reached it before; `blocked` the part of
// that which the building cuts off, from the same directions, so that 0 <= blocked <= natural.
// `natural` is left zero where nothing is blocked and `natural_needed` is false: most of a photo.
struct SplitLight {
  LightGeometry natural, blocked;
  bool IsChanged() const { return blocked.sun > 0 || blocked.sky > 0; }
};
SplitLight SplitDaylight(const MontageScene& scene, const SurfacePoint& surface,
                         const LightDirections& directions, bool natural_needed);

// The sun's part alone.
struct SplitSun {
  double natural = 0;                   // n.d_s Omega_s [sr]
  Spectrum blocked = Spectrum::Zero();  // the part of it [sr] that does not come through
  bool is_blocked = false;              // at least in part
};
SplitSun SplitSunlight(const MontageScene& scene, const SurfacePoint& surface,
                       const LightDirections& directions, bool natural_needed);
// What of it reaches a point of the building: n.d_s Omega_s [sr], times what glass lets through.
Spectrum SunOnBuilding(const MontageScene& scene, const SurfacePoint& surface,
                       const LightDirections& directions);

// Light at a point of the building: what neither the site nor the building itself blocks.
LightGeometry DaylightOnBuilding(const MontageScene& scene, const SurfacePoint& surface,
                                 const LightDirections& directions);

// Light of a lamp at a point: from a point of its luminous sphere that the camera ray chooses, and
// how much of it arrives across its direction, what stands between taken into account.
struct LampLight {
  Eigen::Vector3d direction;  // unit, towards the lamp
  Spectrum normal_irradiance = Spectrum::Zero();
};
LampLight LampLightAt(const MontageScene& scene, const LampSpectrum& lamp,
                      const Eigen::Vector3d& point, const LightDirections& directions);

// Irradiance of the lamps, what stands between taken into account.
Spectrum LampIrradiance(const MontageScene& scene, const SurfacePoint& surface,
                        const LightDirections& directions);

// Irradiance of a natural surface before and what the building changes of it; of the lamps alone
// where they are counted apart.
struct LightBalance {
  Spectrum before, change;
  std::optional<Spectrum> lamps = {};
};
// D1 and D3 in one: what the building takes of sun, sky and surroundings, and what it sends.
// `around` is the light of the latter two there; nullopt: the paper's. nullopt: nothing, case D2.
std::optional<LightBalance> BalanceAt(const MontageScene& scene, const SurfacePoint& surface,
                                      const LightDirections& light,
                                      const std::optional<SmoothLight>& around);
// The change of a surface's radiance by it, not below -true_color.
Spectrum ChangeBy(const LightBalance& balance, const Spectrum& true_color, double diffuse_weight);
// The same of each light by itself, without the bounds that hold for their sum.
void NoteChange(const LightBalance& balance, const Spectrum& true_color, double diffuse_weight,
                RayParts* parts);

// Light rays start this far off the building's faces, which are exact [m].
constexpr double kBuildingClearance = 0.001;

}  // namespace insitu
