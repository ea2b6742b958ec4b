// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/surroundings.h"

#include <optional>

#include "calibration/error.h"
#include "radiometry/daylight.h"
#include "reconstruction/ray_scene.h"

namespace insitu {
namespace {

constexpr int kPolarFacets = 16;     // 1024 directions over the hemisphere above a point
constexpr double kSamePlace = 0.05;  // [m], sights that end within it end on one surface

// The colours of surfaces as the photographs show them.
class PhotographedSurfaces {
 public:
  PhotographedSurfaces(const SceneGeometry& scene, const std::vector<Photograph>& photos,
                       const Atmosphere& air, const SpectralBasis& spectra)
      : scene_(scene),
        photos_(photos),
        air_(air),
        spectra_(spectra),
        polygons_(MeshOfPolygons(scene)),
        rays_(polygons_.mesh) {}

  struct Hit {
    int polygon;
    Eigen::Vector3d position;  // [m], world
  };

  std::optional<Hit> Nearest(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    const auto hit = rays_.Nearest({from - scene_.origin, direction});
    if (!hit) return std::nullopt;
    return Hit{polygons_.polygon_of_triangle[hit->triangle], from + hit->distance * direction};
  }

  // True colour of a place, seen from the side that `towards` lies on; nullopt if no photo shows
  // it.
  std::optional<Spectrum> TrueColorAt(const Hit& place, const Eigen::Vector3d& towards) const {
    const std::optional<int> preferred = scene_.polygons[place.polygon].photo;
    if (preferred) {
      if (const auto color = TrueColorIn(*preferred, place, towards)) return color;
    }
    for (int photo = 0; photo < static_cast<int>(photos_.size()); ++photo) {
      if (const auto color = TrueColorIn(photo, place, towards)) return color;
    }
    return std::nullopt;
  }

 private:
  std::optional<Spectrum> TrueColorIn(int photo, const Hit& place,
                                      const Eigen::Vector3d& towards) const {
    const PosedCamera& posed = scene_.cameras[photo];
    const Eigen::Vector3d center = Center(posed.cam_from_world);
    const Eigen::Vector3d& normal = scene_.polygons[place.polygon].normal;
    const Eigen::Vector3d sight = place.position - center;
    const bool same_side = normal.dot(-sight) * normal.dot(towards - place.position) > 0;
    const auto pixel = posed.camera.Project(posed.cam_from_world * place.position);
    if (!same_side || !pixel || !posed.camera.Sees(*pixel)) return std::nullopt;
    const auto first = Nearest(center, sight.normalized());
    if (first && (first->position - center).norm() < sight.norm() - kSamePlace) return std::nullopt;
    const Eigen::Vector3d rgb = Interpolate(photos_[photo].linear, *pixel);
    return TrueColor(spectra_.SpectrumFromRgb(rgb), air_, sight.norm());
  }

  const SceneGeometry& scene_;
  const std::vector<Photograph>& photos_;
  const Atmosphere& air_;
  const SpectralBasis& spectra_;
  PolygonMesh polygons_;
  RayScene rays_;
};

struct Gathered {
  Spectrum irradiance = Spectrum::Zero();  // from what a photograph shows
  double seen = 0, unseen = 0;             // projected solid angles [sr], the sky's left out
};

Gathered Gather(const SurfacePoint& point, const PhotographedSurfaces& surfaces,
                const Eigen::Vector3d& zenith) {
  Gathered gathered;
  const Eigen::Vector3d origin = point.position + kRayOffset * point.normal;
  const SkyFacets hemisphere = MakeSkyFacets(point.normal, kPolarFacets);
  for (const Eigen::Vector3d& direction : hemisphere.directions) {
    const double weight = point.normal.dot(direction) * hemisphere.solid_angle;
    const auto hit = surfaces.Nearest(origin, direction);
    if (!hit && direction.dot(zenith) > 0) continue;  // sky
    const auto color = hit ? surfaces.TrueColorAt(*hit, origin) : std::nullopt;
    (color ? gathered.seen : gathered.unseen) += weight;
    if (color) gathered.irradiance += weight * *color;
  }
  return gathered;
}

}  // namespace

std::vector<Spectrum> GatherSurroundings(const std::vector<SurfacePoint>& points,
                                         const SceneGeometry& scene,
                                         const std::vector<Photograph>& photos,
                                         const Atmosphere& air, const SpectralBasis& spectra) {
  INSITU_CHECK(photos.size() == scene.cameras.size());
  const PhotographedSurfaces surfaces(scene, photos, air, spectra);
  std::vector<Gathered> gathered;
  Spectrum sum = Spectrum::Zero();
  double seen = 0;
  for (const SurfacePoint& point : points) {
    gathered.push_back(Gather(point, surfaces, scene.zenith.unit));
    sum += gathered.back().irradiance;
    seen += gathered.back().seen;
  }
  std::vector<Spectrum> irradiances;
  if (seen == 0) return irradiances;
  const Spectrum mean_radiance = sum / seen;
  for (const Gathered& one : gathered) {
    // Haze taken off a dark pixel may leave less than nothing.
    irradiances.push_back((one.irradiance + one.unseen * mean_radiance).max(0));
  }
  return irradiances;
}

}  // namespace insitu
