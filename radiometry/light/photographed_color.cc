// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/photographed_color.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace insitu {
namespace {

PosedCamera InLocalFrame(PosedCamera posed, const Eigen::Vector3d& origin) {
  posed.cam_from_world.translation = posed.cam_from_world * origin;
  return posed;
}

constexpr double kFade = 0.05;  // of a frame's shorter side: where its edge begins to count
constexpr size_t kMostOthers = 3;

// 1 within a frame, falling to 0 at its edge.
double FadeAt(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d size(camera.width(), camera.height());
  const double margin =
      std::min((pixel.array() + 0.5).minCoeff(), (size - pixel).array().minCoeff() - 0.5);
  return std::clamp(margin / (kFade * size.minCoeff()), 0.0, 1.0);
}

// Pixels on a unit of a surface's area [1/m^2]; 0 if it has no image beside that of the point.
double ResolutionAt(const LocalImage& image, const SurfacePoint& surface,
                    const Eigen::Vector2d& pixel) {
  const double step = 1e-3 * (image.center - surface.position).norm();
  const Eigen::Vector3d u = surface.normal.unitOrthogonal(), v = surface.normal.cross(u);
  const PosedCamera& posed = image.camera;
  const auto beside = [&](const Eigen::Vector3d& way) {
    return posed.camera.Project(posed.cam_from_world * (surface.position + step * way));
  };
  const auto a = beside(u), b = beside(v);
  if (!a || !b) return 0;
  const Eigen::Vector2d x = *a - pixel, y = *b - pixel;
  return std::abs(x.x() * y.y() - x.y() * y.x()) / (step * step);
}

// A place in a photograph's frame that faces it.
struct Sighting {
  const LocalImage* image = nullptr;
  Eigen::Vector2d pixel;
  double fade = 1;        // 0..1
  double resolution = 0;  // times `fade`
};

std::optional<Sighting> SightIn(const LocalImage& image, const SurfacePoint& surface) {
  if (surface.normal.dot(image.center - surface.position) <= 0) return std::nullopt;
  const auto pixel = image.camera.camera.Project(image.camera.cam_from_world * surface.position);
  if (!pixel || !image.camera.camera.Sees(*pixel)) return std::nullopt;
  return Sighting{&image, *pixel, FadeAt(image.camera.camera, *pixel)};
}

// nullopt: something hides it.
std::optional<PhotographedColor> ColorOf(const PhotographedSite& site, const Sighting& sighting,
                                         int polygon, const SurfacePoint& surface) {
  const LocalImage& image = *sighting.image;
  if (image.shows && !image.shows(polygon, sighting.pixel)) return std::nullopt;
  const Eigen::Vector3d start = surface.position + kSurveyClearance * surface.normal;
  const Eigen::Vector3d path = image.center - start;
  const double distance = path.norm();
  if (surface.normal.dot(path) <= 0) return std::nullopt;
  if (site.rays.IsOccluded({start, path / distance, 0, distance})) return std::nullopt;
  const Eigen::Vector3d rgb = image.rgb(sighting.pixel);
  if (rgb.isZero(0)) return std::nullopt;  // an input image beyond what the lens saw
  const Spectrum L = site.spectra.SpectrumFromRgb(rgb);
  return PhotographedColor{TrueColor(L, site.air, distance).max(0), path / distance};
}

// Those that show it, but for one, the best first; their weights are `share` in all. The first that
// is left out sets where weights begin, so that one comes in and goes out with none.
void AddOthers(const PhotographedSite& site, std::optional<int> but, int polygon,
               const SurfacePoint& surface, double share, std::vector<PhotographedColor>* colors) {
  std::vector<Sighting> sightings;
  for (size_t i = 0; i < site.images.size(); ++i) {
    if (but && static_cast<int>(i) == *but) continue;
    auto sighting = SightIn(site.images[i], surface);
    if (!sighting) continue;
    sighting->resolution = sighting->fade * ResolutionAt(site.images[i], surface, sighting->pixel);
    sightings.push_back(*sighting);
  }
  std::stable_sort(sightings.begin(), sightings.end(),
                   [](const auto& a, const auto& b) { return a.resolution > b.resolution; });
  const size_t first = colors->size();
  double least = 0, sum = 0;
  for (const Sighting& sighting : sightings) {
    auto color = ColorOf(site, sighting, polygon, surface);
    if (!color) continue;
    if (colors->size() == first + kMostOthers) {
      least = sighting.resolution;
      break;
    }
    color->weight = sighting.resolution;
    colors->push_back(*color);
  }
  const std::span<PhotographedColor> others(colors->begin() + first, colors->end());
  for (PhotographedColor& color : others) sum += color.weight -= least;
  for (PhotographedColor& color : others) {
    color.weight =
        sum > 0 ? share * color.weight / sum : share / static_cast<double>(others.size());
  }
}

}  // namespace

LocalImage::LocalImage(const PosedCamera& posed, const Eigen::Vector3d& origin, ImageFunction image)
    : camera(InLocalFrame(posed, origin)),
      center(Center(camera.cam_from_world)),
      rgb(std::move(image)) {}

LocalImage::LocalImage(const PosedCamera& posed, const Eigen::Vector3d& origin, const Raster& image)
    : LocalImage(posed, origin,
                 [&image](const Eigen::Vector2d& pixel) { return Interpolate(image, pixel); }) {}

std::vector<PhotographedColor> LookUpColors(const PhotographedSite& site, int polygon,
                                            const SurfacePoint& surface) {
  std::vector<PhotographedColor> colors;
  const std::optional<int> attribute = site.scene.polygons[polygon].photo;
  if (attribute) {
    const auto sighting = SightIn(site.images[*attribute], surface);
    auto color = sighting ? ColorOf(site, *sighting, polygon, surface) : std::nullopt;
    if (color) {
      color->weight = sighting->fade;
      colors.push_back(*color);
    }
  }
  const double left = colors.empty() ? 1 : 1 - colors.front().weight;
  const bool asks_others = !site.by_attribute_alone || !attribute;
  if (left > 0 && asks_others) AddOthers(site, attribute, polygon, surface, left, &colors);
  if (colors.size() == 1) colors.front().weight = 1;
  return colors;
}

std::optional<Spectrum> LookUpColor(const PhotographedSite& site, int polygon,
                                    const SurfacePoint& surface) {
  const std::vector<PhotographedColor> colors = LookUpColors(site, polygon, surface);
  if (colors.empty()) return std::nullopt;
  Spectrum mean = Spectrum::Zero();
  for (const PhotographedColor& color : colors) mean += color.weight * color.true_color;
  return mean;
}

}  // namespace insitu
