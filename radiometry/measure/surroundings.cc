// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/surroundings.h"

#include <optional>

#include "radiometry/light/daylight.h"

namespace insitu {
namespace {

constexpr int kPolarFacets = 16;  // 1024 directions over the hemisphere above a point

struct Gathered {
  Spectrum irradiance = Spectrum::Zero();  // from what a photograph shows
  double seen = 0, unseen = 0;             // projected solid angles [sr], the sky's left out
};

// The true colour of what lies in a direction; nullopt if no photograph shows it.
std::optional<Spectrum> ColorOfHit(const PhotographedSite& site, const RayHit& hit,
                                   const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  const int polygon = site.polygon_of_triangle[hit.triangle];
  Eigen::Vector3d normal = site.scene.polygons[polygon].normal;
  if (normal.dot(direction) > 0) normal = -normal;
  const auto seen = LookUpColor(site, polygon, {origin + hit.distance * direction, normal});
  return seen ? std::optional(seen->true_color) : std::nullopt;
}

Gathered Gather(const SurfacePoint& point, const PhotographedSite& site) {
  Gathered gathered;
  const Eigen::Vector3d origin = point.position + kSurveyClearance * point.normal;
  const SkyFacets hemisphere = MakeSkyFacets(point.normal, kPolarFacets);
  for (const Eigen::Vector3d& direction : hemisphere.directions) {
    const double weight = point.normal.dot(direction) * hemisphere.solid_angle;
    const auto hit = site.rays.Nearest({origin, direction});
    if (!hit && direction.dot(site.scene.zenith.unit) > 0) continue;  // sky
    const auto color = hit ? ColorOfHit(site, *hit, origin, direction) : std::nullopt;
    (color ? gathered.seen : gathered.unseen) += weight;
    if (color) gathered.irradiance += weight * *color;
  }
  return gathered;
}

}  // namespace

std::vector<Spectrum> GatherSurroundings(const std::vector<SurfacePoint>& points,
                                         const PhotographedSite& site) {
  std::vector<Gathered> gathered;
  Spectrum sum = Spectrum::Zero();
  double seen = 0;
  for (const SurfacePoint& point : points) {
    gathered.push_back(Gather(point, site));
    sum += gathered.back().irradiance;
    seen += gathered.back().seen;
  }
  std::vector<Spectrum> irradiances;
  if (seen == 0) return irradiances;
  const Spectrum mean_radiance = sum / seen;
  for (const Gathered& one : gathered) {
    irradiances.push_back(one.irradiance + one.unseen * mean_radiance);
  }
  return irradiances;
}

}  // namespace insitu
