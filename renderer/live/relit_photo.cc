// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/relit_photo.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <span>

#include "radiometry/light/illumination.h"
#include "radiometry/light/photographed_color.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr size_t kDirectionsAtOnce = 16;  // of RayScene::OcclusionMask

// What a place on a polygon sees of the sky, which its neighbours see too, nearly.
struct SkySeen {
  int polygon = -1;
  double solid_angle = 0;  // weighted by the cosine [sr]
};
constexpr int kSkyBlock = 2;  // [px], of neighbours on one polygon, for which the sky is asked once

// Sun and sky as directions to ask for, 16 at once.
struct LightRays {
  explicit LightRays(const Daylight& light)
      : facets(MakeSkyFacets(light.zenith_direction, light.polar_facets)) {
    for (const Eigen::Vector3d& point : SunPoints(light)) sun.push_back(point.cast<float>());
  }

  SkyFacets facets;
  std::vector<Eigen::Vector3f> sun;
};

class Relighting {
 public:
  Relighting(const NaturalEnvironment& environment, int camera)
      : environment_(environment),
        polygons_(MeshOfPolygons(environment.scene)),
        rays_(polygons_.mesh),
        light_(environment.light),
        posed_(environment.scene.cameras[camera]),
        world_from_cam_(Inverse(posed_.cam_from_world)) {}

  // False: the pixel keeps its colour. `pixel` is of the whole photograph.
  bool Relight(const Eigen::Vector2d& pixel, const Eigen::Vector3d& rgb, SkySeen* sky,
               Eigen::Vector3d* without_sun, Eigen::Vector3d* sun_alone) const {
    const Eigen::Vector3d direction = world_from_cam_.rotation * posed_.camera.Unproject(pixel);
    const Ray sight = {world_from_cam_.translation - environment_.scene.origin, direction};
    const auto hit = rays_.Nearest(sight);
    if (!hit) return false;
    const int index = polygons_.polygon_of_triangle[hit->triangle];
    const Polygon& polygon = environment_.scene.polygons[index];
    if (environment_.materials.at(polygon.material).specular) return false;
    const bool is_behind = polygon.normal.dot(direction) > 0;
    const LightGeometry geometry =
        LightAt({sight.origin + hit->distance * direction,
                 is_behind ? Eigen::Vector3d(-polygon.normal) : polygon.normal},
                index, sky);
    const Spectrum total = TotalIrradiance(environment_.light, geometry);
    if (!(total > 0).any()) return false;
    const Spectrum sun = SunIrradiance(environment_.light, geometry);
    const Spectrum color =
        TrueColor(environment_.spectra.SpectrumFromRgb(rgb), environment_.air, hit->distance)
            .max(0);
    const Spectrum brdf = DiffuseBrdf(color, 1, total);  // k_d cancels
    *without_sun = Seen(ReflectedRadiance(1, brdf, total - sun), hit->distance);
    *sun_alone = Seen(ReflectedRadiance(1, brdf, sun), hit->distance);
    return true;
  }

 private:
  // MeasureLight, by packets of rays.
  LightGeometry LightAt(const SurfacePoint& surface, int polygon, SkySeen* sky) const {
    const Daylight& light = environment_.light;
    const Eigen::Vector3d origin = surface.position + kSurveyClearance * surface.normal;
    LightGeometry geometry;
    geometry.ambient = std::numbers::pi;
    const double sun_cosine = surface.normal.dot(light.sun_direction);
    if (sun_cosine > 0) {
      const int hidden = std::popcount(rays_.OcclusionMask(origin, light_.sun, 0));
      geometry.sun = sun_cosine * light.sun_solid_angle * (1 - double(hidden) / kSunPoints);
    }
    if (sky->polygon != polygon) *sky = {polygon, SkyAt(surface.normal, origin)};
    geometry.sky = sky->solid_angle;
    return geometry;
  }

  double SkyAt(const Eigen::Vector3d& normal, const Eigen::Vector3d& origin) const {
    std::vector<Eigen::Vector3f> directions;
    std::vector<double> cosines;
    double visible = 0;
    const auto ask = [&] {
      const unsigned hidden = rays_.OcclusionMask(origin, directions, 0);
      for (size_t i = 0; i < cosines.size(); ++i) visible += hidden >> i & 1 ? 0 : cosines[i];
      directions.clear();
      cosines.clear();
    };
    for (const Eigen::Vector3d& facet : light_.facets.directions) {
      const double cosine = normal.dot(facet);
      if (cosine <= 0) continue;
      directions.push_back(facet.cast<float>());
      cosines.push_back(cosine);
      if (directions.size() == kDirectionsAtOnce) ask();
    }
    if (!directions.empty()) ask();
    return visible * light_.facets.solid_angle;
  }

  Eigen::Vector3d Seen(const Spectrum& color, double distance) const {
    return environment_.spectra.RgbFromSpectrum(ApparentColor(color, environment_.air, distance));
  }

  const NaturalEnvironment& environment_;
  const PolygonMesh polygons_;
  const RayScene rays_;
  const LightRays light_;
  const PosedCamera& posed_;
  const Rigid3 world_from_cam_;
};

}  // namespace

std::optional<RelitPhoto> RelightPhoto(const NaturalEnvironment& environment, int camera,
                                       const Raster& photo,
                                       const std::function<bool()>& is_stopped) {
  const Relighting relighting(environment, camera);
  const double step = double(environment.scene.cameras[camera].camera.width()) / photo.width;
  RelitPhoto relit{photo, photo, std::vector<bool>(size_t(photo.width) * photo.height)};
  std::vector<SkySeen> skies(photo.width / kSkyBlock + 1);
  for (int y = 0; y < photo.height; ++y) {
    if (is_stopped && is_stopped()) return std::nullopt;
    if (y % kSkyBlock == 0) std::fill(skies.begin(), skies.end(), SkySeen());
    for (int x = 0; x < photo.width; ++x) {
      const Eigen::Vector2d pixel = (step * Eigen::Array2d(x + 0.5, y + 0.5) - 0.5).matrix();
      Eigen::Vector3d without_sun, sun_alone;
      if (!relighting.Relight(pixel, photo.Rgb(x, y), &skies[x / kSkyBlock], &without_sun,
                              &sun_alone)) {
        continue;
      }
      relit.is_relit[size_t(y) * photo.width + x] = true;
      relit.without_sun.SetRgb(x, y, without_sun);
      relit.sun_alone.SetRgb(x, y, sun_alone);
    }
  }
  return relit;
}

}  // namespace insitu
