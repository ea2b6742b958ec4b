// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/photographed_color.h"

namespace insitu {
namespace {

PosedCamera InLocalFrame(PosedCamera posed, const Eigen::Vector3d& origin) {
  posed.cam_from_world.translation = posed.cam_from_world * origin;
  return posed;
}

std::optional<PhotographedColor> LookUpIn(const PhotographedSite& site, const LocalImage& image,
                                          const SurfacePoint& surface) {
  const Eigen::Vector3d start = surface.position + kSurveyClearance * surface.normal;
  const Eigen::Vector3d path = image.center - start;
  const double distance = path.norm();
  if (surface.normal.dot(path) <= 0) return std::nullopt;
  const auto pixel = image.camera.camera.Project(image.camera.cam_from_world * surface.position);
  if (!pixel || !image.camera.camera.Sees(*pixel)) return std::nullopt;
  if (site.rays.IsOccluded({start, path / distance, 0, distance})) return std::nullopt;
  const Eigen::Vector3d rgb = image.rgb(*pixel);
  if (rgb.isZero(0)) return std::nullopt;  // an input image beyond what the lens saw
  const Spectrum L = site.spectra.SpectrumFromRgb(rgb);
  return PhotographedColor{TrueColor(L, site.air, distance).max(0), path / distance};
}

}  // namespace

LocalImage::LocalImage(const PosedCamera& posed, const Eigen::Vector3d& origin, ImageFunction image)
    : camera(InLocalFrame(posed, origin)),
      center(Center(camera.cam_from_world)),
      rgb(std::move(image)) {}

LocalImage::LocalImage(const PosedCamera& posed, const Eigen::Vector3d& origin, const Raster& image)
    : LocalImage(posed, origin,
                 [&image](const Eigen::Vector2d& pixel) { return Interpolate(image, pixel); }) {}

std::optional<PhotographedColor> LookUpColor(const PhotographedSite& site, int polygon,
                                             const SurfacePoint& surface) {
  const std::optional<int> attribute = site.scene.polygons[polygon].photo;
  if (attribute) {
    if (auto color = LookUpIn(site, site.images[*attribute], surface)) return color;
  }
  for (size_t i = 0; i < site.images.size(); ++i) {
    if (attribute && static_cast<int>(i) == *attribute) continue;
    if (auto color = LookUpIn(site, site.images[i], surface)) return color;
  }
  return std::nullopt;
}

}  // namespace insitu
