// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/place.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

constexpr double kEndless = std::numeric_limits<double>::infinity();

Eigen::Matrix3d BasisAbout(const Vector3d& axis) {
  Eigen::Matrix3d basis;
  basis.col(0) = axis.unitOrthogonal();
  basis.col(1) = axis.cross(basis.col(0));
  basis.col(2) = axis;
  return basis;
}

Spot SpotAt(const Ray& ray, const Hit& hit, bool on_building) {
  const double side = hit.face->normal.dot(ray.direction) > 0 ? -1 : 1;
  const Vector3d normal = side * hit.face->normal;
  const Vector3d point = ray.origin + hit.distance * ray.direction + kLift * normal;
  return {hit.face, point, normal, hit.distance, on_building};
}

Sighting WithBuilding(const Place& place, const Ray& ray, const std::optional<Hit>& natural) {
  Sighting seen;
  if (natural) seen.before = seen.after = SpotAt(ray, *natural, false);
  const auto building = NearestHit(place.building, ray, natural ? natural->distance : kEndless);
  if (building) seen.after = SpotAt(ray, *building, true);
  return seen;
}

}  // namespace

Sighting Look(const Place& place, const Ray& ray) {
  std::optional<Hit> natural = NearestHit(place.site->natural, ray);
  const double limit = natural ? natural->distance : kEndless;
  const std::optional<Hit> beyond = NearestHit(place.site->scenery, ray, limit);
  return WithBuilding(place, ray, beyond ? beyond : natural);
}

Sighting LookForLight(const Place& place, const Ray& ray) {
  std::optional<Hit> natural = NearestHit(place.site->natural, ray);
  if (!natural && ray.direction.dot(place.site->zenith) <= 0) {
    natural = NearestHit(place.site->scenery, ray);
  }
  return WithBuilding(place, ray, natural);
}

std::vector<Vector3d> CosineDirections(const Vector3d& normal, int strata, uint64_t seed) {
  Random random(seed, 3, 0);
  const Eigen::Matrix3d site_from_normal = BasisAbout(normal);
  std::vector<Vector3d> directions;
  directions.reserve(static_cast<size_t>(strata) * strata);
  for (int i = 0; i < strata * strata; ++i) {
    const int column = i % strata, row = i / strata;
    const double square_sine = (row + random.Uniform()) / strata;
    const double turn = 2 * std::numbers::pi * (column + random.Uniform()) / strata;
    const double sine = std::sqrt(square_sine), cosine = std::sqrt(1 - square_sine);
    directions.emplace_back(site_from_normal *
                            Vector3d(sine * std::cos(turn), sine * std::sin(turn), cosine));
  }
  return directions;
}

BeforeAfter VisibleSun(const Place& place, const Vector3d& point, const Vector3d& normal,
                       uint64_t seed) {
  constexpr int kRays = 4;
  if (!place.site->has_sun || normal.dot(place.site->sun) <= 0) return {};
  Random random(seed, 4, 0);
  const Eigen::Matrix3d site_from_sun = BasisAbout(place.site->sun);
  const double reach = std::tan(kSunDiameter / 2), start = random.Uniform();
  BeforeAfter seen;
  for (int i = 0; i < kRays; ++i) {  // a golden-angle spiral over the disc
    const double r = reach * std::sqrt((i + random.Uniform()) / kRays);
    const double turn = 2 * std::numbers::pi * (start + 0.381966011 * i);
    const Vector3d toward(r * std::cos(turn), r * std::sin(turn), 1);
    const Ray ray{point, (site_from_sun * toward).normalized()};
    if (IsBlocked(place.site->blockers, ray)) continue;
    seen.before += 1;
    if (!IsBlocked(place.building, ray)) seen.after += 1;
  }
  return {seen.before / kRays, seen.after / kRays};
}

}  // namespace insitu::demo
