// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/light_split.h"

#include <array>
#include <bitset>
#include <cmath>
#include <numbers>
#include <span>

#include "radiometry/light/illumination.h"
#include "renderer/trace/profile.h"
#include "renderer/trace/through_glass.h"

namespace insitu {
namespace {

constexpr int kPacket = 16;

bool IsBlocked(const RayScene& rays, const Ray& ray) {
  const PhaseScope phase(Phase::kEmbree);
  return rays.IsOccluded(ray);
}

uint16_t BlockedOf(const RayScene& rays, const Eigen::Vector3d& origin,
                   std::span<const Eigen::Vector3f> directions) {
  const PhaseScope phase(Phase::kEmbree);
  return rays.OcclusionMask(origin, directions, 0);
}

// Up to 16 sky facets with the weight that each has at a surface.
struct FacetPacket {
  std::array<Eigen::Vector3f, kPacket> directions;
  std::array<double, kPacket> cosines;
  std::array<int, kPacket> facets;
  int size = 0;

  void Add(int facet, const Eigen::Vector3f& direction, double cosine) {
    directions[size] = direction;
    cosines[size] = cosine;
    facets[size++] = facet;
  }
  std::span<const Eigen::Vector3f> Span() const {
    return {directions.data(), static_cast<size_t>(size)};
  }
};

// Calls visit(packet) for the facets of this ray that face the surface and pass `wanted(facet)`.
template <typename Wanted, typename Visit>
void ForFacets(const MontageScene& scene, const SurfacePoint& surface,
               const LightDirections& directions, const Wanted& wanted, const Visit& visit) {
  FacetPacket packet;
  const int count = static_cast<int>(scene.facet_directions.size());
  for (int i = directions.first; i < count; i += directions.stride) {
    const double cosine = surface.normal.dot(scene.facets.directions[i]);
    if (cosine <= 0 || !wanted(i)) continue;
    packet.Add(i, scene.facet_directions[i], cosine);
    if (packet.size < kPacket) continue;
    visit(packet);
    packet.size = 0;
  }
  if (packet.size > 0) visit(packet);
}

double FacetWeight(const MontageScene& scene, const LightDirections& directions) {
  return scene.facets.solid_angle * directions.stride;
}

double SunCosine(const MontageScene& scene, const SurfacePoint& surface,
                 const LightDirections& directions) {
  const Daylight& light = scene.natural.light;
  const bool is_up = light.zenith_direction.dot(directions.sun) > 0;
  return is_up ? std::max(0.0, surface.normal.dot(directions.sun)) : 0;
}

bool MayMeetBuilding(const MontageScene& scene, const Eigen::Vector3d& origin,
                     const Eigen::Vector3d& direction) {
  return !scene.building_box.IsEmpty() &&
         scene.building_box.MayMeet(origin.cast<float>().array(),
                                    direction.cast<float>().array().inverse());
}

using FacetSet = std::bitset<kMostFacets>;

// The facets of this ray that the building hides.
FacetSet FacetsBehindBuilding(const MontageScene& scene, const SurfacePoint& surface,
                              const Eigen::Vector3d& origin, const LightDirections& directions) {
  FacetSet hidden;
  if (scene.building_box.IsEmpty()) return hidden;
  const Eigen::Array3f start = origin.cast<float>().array();
  ForFacets(
      scene, surface, directions,
      [&](int i) { return scene.building_box.MayMeet(start, scene.inverse_facet_directions[i]); },
      [&](const FacetPacket& packet) {
        const unsigned blocked = BlockedOf(scene.OpaqueRays(), origin, packet.Span());
        for (int i = 0; i < packet.size; ++i) hidden[packet.facets[i]] = blocked >> i & 1;
      });
  return hidden;
}

// A point of a luminous sphere of unit radius, as seen along `to_lamp`: on its disc.
Eigen::Vector3d PointOnLamp(const Eigen::Vector3d& to_lamp, const Eigen::Vector2d& uniform) {
  const Eigen::Vector3d u = to_lamp.unitOrthogonal(), v = to_lamp.cross(u);
  const double radius = std::sqrt(uniform.x()), angle = 2 * std::numbers::pi * uniform.y();
  return radius * (std::cos(angle) * u + std::sin(angle) * v);
}

// No surface sends back more than it receives, but for errors of photograph and light: they must
// not grow where light is added.
Spectrum BoundedBrdf(const Spectrum& brdf, const LightBalance& balance, double diffuse_weight) {
  return (balance.change > 0).select(brdf.min(1 / (diffuse_weight * std::numbers::pi)), brdf);
}

}  // namespace

LightDirections ChooseLightDirections(const MontageScene& scene, const Eigen::Vector2d& disc,
                                      int ray, const Eigen::Vector2d& facet, uint64_t seed) {
  const Eigen::Vector3d d_s = scene.natural.light.sun_direction;
  const Eigen::Vector3d u = d_s.unitOrthogonal();
  const Eigen::Vector3d v = d_s.cross(u);
  const double radius = scene.solar_disc_radius * std::sqrt(disc.x());
  const double angle = 2 * std::numbers::pi * disc.y();
  const Eigen::Vector3d sun =
      (d_s + radius * (std::cos(angle) * u + std::sin(angle) * v)).normalized();
  // Fewer than 16 facets a ray would be too coarse to take turns.
  const int stride = scene.facet_directions.size() >= 64 ? 4 : 1;
  return {sun, ray % stride, stride, facet, seed};
}

SplitSun SplitSunlight(const MontageScene& scene, const SurfacePoint& surface,
                       const LightDirections& directions, bool natural_needed) {
  SplitSun sun;
  const Eigen::Vector3d origin = surface.position + kSurveyClearance * surface.normal;
  const Ray to_sun = {origin, directions.sun};
  const double cosine = SunCosine(scene, surface, directions);
  if (cosine <= 0) return sun;
  Spectrum through = Spectrum::Ones();
  if (MayMeetBuilding(scene, origin, directions.sun)) through = TransmittanceAlong(scene, to_sun);
  const bool is_blocked = (through < 1).any();
  if (!is_blocked && !natural_needed) return sun;
  if (IsBlocked(scene.natural_rays, to_sun)) return sun;
  sun.natural = cosine * scene.natural.light.sun_solid_angle * directions.sun_share;
  sun.is_blocked = is_blocked;
  if (is_blocked) sun.blocked = sun.natural * (1 - through);
  return sun;
}

Spectrum SunOnBuilding(const MontageScene& scene, const SurfacePoint& surface,
                       const LightDirections& directions) {
  const double cosine = SunCosine(scene, surface, directions);
  const Eigen::Vector3d origin = surface.position + kBuildingClearance * surface.normal;
  const Ray to_sun = {origin, directions.sun};
  if (cosine <= 0 || IsBlocked(scene.natural_rays, to_sun)) return Spectrum::Zero();
  return cosine * scene.natural.light.sun_solid_angle * TransmittanceAlong(scene, to_sun);
}

SplitLight SplitDaylight(const MontageScene& scene, const SurfacePoint& surface,
                         const LightDirections& directions, bool natural_needed) {
  SplitLight light;
  const Eigen::Vector3d origin = surface.position + kSurveyClearance * surface.normal;
  const FacetSet hidden = FacetsBehindBuilding(scene, surface, origin, directions);
  const SplitSun sun = SplitSunlight(scene, surface, directions, natural_needed || hidden.any());
  light.natural.sun = sun.natural;
  light.blocked.sun = sun.blocked.head(scene.natural.spectra.bins().count).mean();
  if (!natural_needed && !sun.is_blocked && hidden.none()) return {};
  light.natural.ambient = std::numbers::pi;
  double visible = 0, blocked = 0;
  ForFacets(
      scene, surface, directions, [](int) { return true; },
      [&](const FacetPacket& packet) {
        const unsigned covered = BlockedOf(scene.natural_rays, origin, packet.Span());
        for (int i = 0; i < packet.size; ++i) {
          if (covered >> i & 1) continue;
          visible += packet.cosines[i];
          if (hidden[packet.facets[i]]) blocked += packet.cosines[i];
        }
      });
  light.natural.sky = visible * FacetWeight(scene, directions);
  light.blocked.sky = blocked * FacetWeight(scene, directions);
  return light;
}

LightGeometry DaylightOnBuilding(const MontageScene& scene, const SurfacePoint& surface,
                                 const LightDirections& directions) {
  LightGeometry light;
  light.ambient = std::numbers::pi;
  const Eigen::Vector3d origin = surface.position + kBuildingClearance * surface.normal;
  light.sun =
      SunOnBuilding(scene, surface, directions).head(scene.natural.spectra.bins().count).mean();
  const FacetSet hidden = FacetsBehindBuilding(scene, surface, origin, directions);
  double visible = 0;
  ForFacets(
      scene, surface, directions, [&](int i) { return !hidden[i]; },
      [&](const FacetPacket& packet) {
        const unsigned covered = BlockedOf(scene.natural_rays, origin, packet.Span());
        for (int i = 0; i < packet.size; ++i) {
          if (!(covered >> i & 1)) visible += packet.cosines[i];
        }
      });
  light.sky = visible * FacetWeight(scene, directions);
  return light;
}

LampLight LampLightAt(const MontageScene& scene, const LampSpectrum& lamp,
                      const Eigen::Vector3d& point, const LightDirections& directions) {
  Eigen::Vector3d path = lamp.position - point;
  if (lamp.radius > 0) path += lamp.radius * PointOnLamp(path.normalized(), directions.facet);
  const double distance = path.norm();
  LampLight light{path / distance};
  const double share = lamp.distribution ? lamp.distribution->At(-light.direction) : 1;
  if (share <= 0) return light;
  const Ray ray = {point, light.direction, 0, distance};
  if (IsBlocked(scene.natural_rays, ray)) return light;
  light.normal_irradiance =
      lamp.intensity * TransmittanceAlong(scene, ray) * (share / (distance * distance));
  return light;
}

Spectrum LampIrradiance(const MontageScene& scene, const SurfacePoint& surface,
                        const LightDirections& directions) {
  Spectrum irradiance = Spectrum::Zero();
  const Eigen::Vector3d origin = surface.position + kSurveyClearance * surface.normal;
  for (const LampSpectrum& lamp : scene.lamps) {
    if (surface.normal.dot(lamp.position - origin) <= 0) continue;
    const LampLight light = LampLightAt(scene, lamp, origin, directions);
    const double cosine = surface.normal.dot(light.direction);
    if (cosine > 0) irradiance += cosine * light.normal_irradiance;
  }
  return irradiance;
}

std::optional<LightBalance> BalanceAt(const MontageScene& scene, const SurfacePoint& surface,
                                      const LightDirections& light,
                                      const std::optional<SmoothLight>& around) {
  const Daylight& daylight = scene.natural.light;
  const Spectrum E_lamps =
      scene.lamps.empty() ? Spectrum::Zero().eval() : LampIrradiance(scene, surface, light);
  const bool lit = (E_lamps > 0).any();
  if (around) {
    const SplitSun sun = SplitSunlight(scene, surface, light, lit || around->matters);
    if (!lit && !around->matters && !sun.is_blocked) return std::nullopt;
    if (light.parts) {  // irradiances, until they meet the surface
      auto& irradiance = light.parts->light;
      const GatheredParts& parts = light.parts->around;
      irradiance[kSunBlocked] = -daylight.sun_radiance * sun.blocked;
      irradiance[kSkyBlocked] = -parts.sky_blocked;
      irradiance[kSurroundingsBlocked] = -parts.surroundings_blocked;
      irradiance[kBounced] = parts.bounced;
      irradiance[kChangeLamps] = E_lamps;
    }
    return LightBalance{daylight.sun_radiance * sun.natural + around->before,
                        E_lamps + around->change - daylight.sun_radiance * sun.blocked};
  }
  const SplitLight split = SplitDaylight(scene, surface, light, lit);
  if (!lit && !split.IsChanged()) return std::nullopt;
  if (light.parts) {
    light.parts->light[kSunBlocked] = -SunIrradiance(daylight, split.blocked);
    light.parts->light[kSkyBlocked] = -SkyIrradiance(daylight, split.blocked);
    light.parts->light[kChangeLamps] = E_lamps;
  }
  return LightBalance{
      TotalIrradiance(daylight, split.natural),
      -(SunIrradiance(daylight, split.blocked) + SkyIrradiance(daylight, split.blocked)), E_lamps};
}

Spectrum ChangeBy(const LightBalance& balance, const Spectrum& true_color, double diffuse_weight) {
  const Spectrum rho = DiffuseBrdf(true_color, diffuse_weight, balance.before);
  if (balance.lamps) {
    const Spectrum removed = ReflectedRadiance(diffuse_weight, rho, balance.change);  // D3
    const Spectrum added = ReflectedRadiance(diffuse_weight, rho, *balance.lamps);    // D1
    return removed.max(-true_color) + added;
  }
  const Spectrum bounded = BoundedBrdf(rho, balance, diffuse_weight);
  return ReflectedRadiance(diffuse_weight, bounded, balance.change).max(-true_color);
}

void NoteChange(const LightBalance& balance, const Spectrum& true_color, double diffuse_weight,
                RayParts* parts) {
  const Spectrum rho = DiffuseBrdf(true_color, diffuse_weight, balance.before);
  const Spectrum used = balance.lamps ? rho : BoundedBrdf(rho, balance, diffuse_weight);
  for (const LightPart part :
       {kSunBlocked, kSkyBlocked, kSurroundingsBlocked, kBounced, kChangeLamps}) {
    Spectrum& light = parts->light[part];
    light = ReflectedRadiance(diffuse_weight, used, light);
  }
}

}  // namespace insitu
