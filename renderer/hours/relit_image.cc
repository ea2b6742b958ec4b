// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/hours/relit_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <numbers>
#include <optional>
#include <vector>

#include "radiometry/light/illumination.h"
#include "radiometry/light/photographed_color.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr int kSkyBlock = 2;  // [px], of neighbours on one polygon, for which the sky is asked once

// One daylight as directions to ask for and what comes from them.
struct LightOfSky {
  LightOfSky(const Daylight& daylight, const SkyFacets& facets)
      : light(daylight),
        open(daylight.sky_radiance + daylight.ambient_radiance),
        sky(daylight.Sky()) {
    for (const Eigen::Vector3d& point : SunPoints(light)) sun.push_back(point.cast<float>());
    for (const Eigen::Vector3d& direction : facets.directions) {
      of_facet.push_back(open * sky.Towards(direction) * facets.solid_angle);
    }
  }
  Spectrum Towards(const Eigen::Vector3d& direction) const { return open * sky.Towards(direction); }

  const Daylight& light;
  Spectrum open;
  RelativeSky sky;
  std::vector<Eigen::Vector3f> sun;
  std::vector<Spectrum> of_facet;  // radiance times solid angle
};

// What sky and surroundings send to a place before and after.
struct SkyLight {
  int polygon = -1;
  Spectrum before = Spectrum::Zero(), after = Spectrum::Zero();
};

Spectrum RatioWherePositive(const Spectrum& after, const Spectrum& before) {
  return (before > 0).select(after / before.max(1e-300), Spectrum::Ones());
}

}  // namespace

struct Relighting::Parts {
  Parts(const NaturalEnvironment& environment, const SimulatedDaylight& simulated_light)
      : measured(environment),
        simulated(simulated_light),
        polygons(MeshOfPolygons(environment.scene)),
        rays(polygons.mesh),
        facets(MakeSkyFacets(environment.light.zenith_direction, environment.light.polar_facets)),
        before(environment.light, facets),
        after(simulated.light, facets),
        air(environment.air) {
    air.horizon *= simulated.level_ratio;
    for (const Eigen::Vector3d& facet : facets.directions) {
      facet_directions.push_back(facet.cast<float>());
    }
  }

  Spectrum SunAt(const SurfacePoint& surface, const Eigen::Vector3d& origin,
                 const LightOfSky& of) const {
    const double cosine = surface.normal.dot(of.light.sun_direction);
    if (cosine <= 0) return Spectrum::Zero();
    const int hidden = std::popcount(rays.OcclusionMask(origin, of.sun, 0));
    return of.light.sun_radiance * of.light.sun_solid_angle * cosine *
           (1 - double(hidden) / kSunPoints);
  }

  // Facets sixteen at once; those below the surface are asked for too, and count nothing.
  SkyLight SkyAt(const SurfacePoint& surface, const Eigen::Vector3d& origin, int polygon) const {
    SkyLight sky{.polygon = polygon};
    double seen = 0;
    for (size_t first = 0; first < facet_directions.size(); first += kPacketSize) {
      const size_t count = std::min<size_t>(kPacketSize, facet_directions.size() - first);
      const unsigned hidden =
          rays.OcclusionMask(origin, std::span(facet_directions).subspan(first, count), 0);
      for (size_t i = 0; i < count; ++i) {
        const double cosine = surface.normal.dot(facets.directions[first + i]);
        if (cosine <= 0 || (hidden >> i & 1) != 0) continue;
        sky.before += cosine * before.of_facet[first + i];
        sky.after += cosine * after.of_facet[first + i];
        seen += cosine * facets.solid_angle;
      }
    }
    const double around = std::max(0.0, std::numbers::pi - seen);
    sky.before += around * measured.light.ambient_radiance;
    sky.after += around * measured.light.ambient_radiance * simulated.level_ratio;
    return sky;
  }

  // True colours. Nothing sends back more than it receives: errors of photograph and light must not
  // grow where light is added.
  static Spectrum Scaled(const Spectrum& color, const Spectrum& light_before,
                         const Spectrum& light_after) {
    const Spectrum plain = color * RatioWherePositive(light_after, light_before);
    const Spectrum most = (light_after / std::numbers::pi).max(color);
    return (light_after > light_before).select(plain.min(most), plain);
  }

  // Above the horizon as the sky there, below it as open level ground.
  Spectrum RatioTowards(const Eigen::Vector3d& direction) const {
    if (direction.dot(measured.light.zenith_direction) <= 0) return simulated.level_ratio;
    return RatioWherePositive(after.Towards(direction), before.Towards(direction));
  }

  Spectrum RelitPixel(const Ray& sight, const Spectrum& apparent, SkyLight* sky) const {
    const auto hit = rays.Nearest(sight);
    if (!hit) return apparent * RatioTowards(sight.direction);
    const int index = polygons.polygon_of_triangle[hit->triangle];
    const Polygon& polygon = measured.scene.polygons[index];
    const bool is_behind = polygon.normal.dot(sight.direction) > 0;
    const SurfacePoint surface = {sight.origin + hit->distance * sight.direction,
                                  is_behind ? Eigen::Vector3d(-polygon.normal) : polygon.normal};
    if (measured.materials.at(polygon.material).specular) {
      const Eigen::Vector3d mirrored =
          sight.direction - 2 * sight.direction.dot(surface.normal) * surface.normal;
      return apparent * RatioTowards(mirrored);
    }
    const Eigen::Vector3d origin = surface.position + kSurveyClearance * surface.normal;
    if (sky->polygon != index) *sky = SkyAt(surface, origin, index);
    const Spectrum color = TrueColor(apparent, measured.air, hit->distance).max(0);
    const Spectrum relit = Scaled(color, sky->before + SunAt(surface, origin, before),
                                  sky->after + SunAt(surface, origin, after));
    return ApparentColor(relit, air, hit->distance);
  }

  const NaturalEnvironment& measured;
  const SimulatedDaylight simulated;
  const PolygonMesh polygons;
  const RayScene rays;
  const SkyFacets facets;
  const LightOfSky before, after;
  std::vector<Eigen::Vector3f> facet_directions;
  Atmosphere air;
};

Relighting::Relighting(const NaturalEnvironment& measured, const SimulatedDaylight& simulated)
    : parts_(std::make_unique<Parts>(measured, simulated)) {}

Relighting::~Relighting() = default;

const Atmosphere& Relighting::air() const { return parts_->air; }

Raster Relighting::Relit(const PosedCamera& camera, const Raster& image) const {
  const Parts& parts = *parts_;
  const Rigid3 world_from_cam = Inverse(camera.cam_from_world);
  const Eigen::Vector3d eye = world_from_cam.translation - parts.measured.scene.origin;
  const SpectralBasis& spectra = parts.measured.spectra;
  Raster relit(image.width, image.height);
  const auto relight_strip = [&](int strip) {
    std::vector<SkyLight> skies(image.width / kSkyBlock + 1);
    const int end = std::min(image.height, (strip + 1) * kSkyBlock);
    for (int y = strip * kSkyBlock; y < end; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Eigen::Vector3d direction =
            (world_from_cam.rotation * camera.camera.Unproject({x, y})).normalized();
        const Spectrum apparent = spectra.SpectrumFromRgb(image.Rgb(x, y));
        relit.SetRgb(x, y,
                     spectra.RgbFromSpectrum(
                         parts.RelitPixel({eye, direction}, apparent, &skies[x / kSkyBlock])));
      }
    }
  };
  tbb::parallel_for(0, (image.height + kSkyBlock - 1) / kSkyBlock, relight_strip);
  return relit;
}

}  // namespace insitu
