// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/scene_hit.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/profile.h"

namespace insitu {
namespace {

// The building's faces win over polygons that survey noise leaves just before them.
constexpr double kCoincidence = 0.01;  // [m]

SurfacePoint Facing(const Ray& ray, double distance, const Eigen::Vector3d& normal) {
  const double side = ray.direction.dot(normal) <= 0 ? 1 : -1;
  return {ray.origin + distance * ray.direction, side * normal};
}

// Nearest of a sphere from outside [m]; nullopt: missed.
std::optional<double> MeetSphere(const Ray& ray, const Eigen::Vector3d& center, double radius) {
  const Eigen::Vector3d to_center = center - ray.origin;
  const double along = to_center.dot(ray.direction);
  const double across2 = (to_center - along * ray.direction).squaredNorm();
  if (across2 >= radius * radius) return std::nullopt;
  const double distance = along - std::sqrt(radius * radius - across2);
  if (distance <= ray.near || distance >= ray.far) return std::nullopt;
  return distance;
}

// Of a panel's luminous side [m].
std::optional<double> MeetPanel(const Ray& ray, const LuminousPanel& panel) {
  const Eigen::Vector3d normal = panel.u.cross(panel.v);
  const double approach = -ray.direction.dot(normal);
  if (approach <= 0) return std::nullopt;
  const double distance = (ray.origin - panel.corner).dot(normal) / approach;
  if (distance <= ray.near || distance >= ray.far) return std::nullopt;
  const Eigen::Vector3d place = ray.origin + distance * ray.direction - panel.corner;
  const double s = place.cross(panel.v).dot(normal), t = panel.u.cross(place).dot(normal);
  const double whole = normal.squaredNorm();
  if (s < 0 || t < 0 || s > whole || t > whole) return std::nullopt;
  return distance;
}

bool IsTowardsBuilding(const MontageScene& scene, const Ray& ray) {
  const InfluenceBox& box = scene.building_box;
  return !box.IsEmpty() && box.MayMeet(ray.origin.cast<float>().array(),
                                       ray.direction.cast<float>().array().inverse());
}

}  // namespace

std::optional<SceneHit> FindHit(const MontageScene& scene, Ray ray, World world) {
  const PhaseScope phase(Phase::kEmbree);
  std::optional<SceneHit> found;
  if (world == World::kWithBuilding && IsTowardsBuilding(scene, ray)) {
    if (const auto hit = scene.artificial_rays.Nearest(ray)) {
      const Eigen::Vector3d& normal = scene.NormalOf(*hit);
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

std::optional<LampHit> FindLamp(const MontageScene& scene, const Ray& ray) {
  std::optional<LampHit> nearest;
  Ray rest = ray;
  for (const LampSpectrum& lamp : scene.lamps) {
    if (!lamp.is_visible) continue;
    const auto distance = MeetSphere(rest, lamp.position, lamp.radius);
    if (!distance) continue;
    const double share = lamp.distribution ? lamp.distribution->At(-ray.direction) : 1;
    const double disc = std::numbers::pi * lamp.radius * lamp.radius;
    nearest = LampHit{*distance, lamp.intensity * (share / disc)};
    rest.far = *distance;
  }
  for (const LuminousPanel& panel : scene.panels) {
    const auto distance = MeetPanel(rest, panel);
    if (!distance) continue;
    nearest = LampHit{*distance, panel.radiance};
    rest.far = *distance;
  }
  return nearest;
}

std::optional<SmoothLight> LightAround(const MontageScene& scene, const SceneHit& hit) {
  if (!scene.interreflected) return std::nullopt;
  if (!hit.place) return SmoothLight{};  // too far to matter
  const InterreflectedLight& light = *scene.interreflected;
  return (hit.is_building ? light.on_building : light.on_site).At(*hit.place);
}

std::optional<SmoothLight> LightBehind(const MontageScene& scene, const SceneHit& hit) {
  SceneHit behind = hit;
  behind.place->is_back = !behind.place->is_back;
  return LightAround(scene, behind);
}

GatheredParts PartsAround(const MontageScene& scene, const SceneHit& hit) {
  if (!scene.interreflected || !hit.place) return {};
  const InterreflectedLight& light = *scene.interreflected;
  return (hit.is_building ? light.on_building : light.on_site).PartsAt(*hit.place);
}

}  // namespace insitu
