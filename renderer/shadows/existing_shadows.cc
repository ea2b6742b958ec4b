// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/shadows/existing_shadows.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "calibration/files/error.h"
#include "calibration/lens/sight_map.h"
#include "renderer/trace/scene_hit.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr double kMostPixels = 4e6;  // that are looked at singly
constexpr double kDarkest = 1e-5;    // linear, of a colour that tells something

// The view in blocks of `block` by `block` pixels.
struct BlockView {
  const MontageScene& scene;
  const Raster& photo;
  const Foreground* foreground;
  SightMap sights;
  Eigen::Matrix3d local_from_cam;
  Vector3d center;  // [m], local
  int block;

  int Columns() const { return photo.width / block; }
  int Rows() const { return photo.height / block; }
};

// nullopt: something stands in front of part of it.
std::optional<Vector3d> MeanOf(const BlockView& view, int column, int row) {
  Vector3d sum = Vector3d::Zero();
  for (int y = row * view.block; y < (row + 1) * view.block; ++y) {
    for (int x = column * view.block; x < (column + 1) * view.block; ++x) {
      if (view.foreground && *view.foreground->share.At(x, y) > 0) return std::nullopt;
      sum += view.photo.Rgb(x, y);
    }
  }
  return sum / (view.block * view.block);
}

// Of the sun that reaches a surface if nothing but polygons stands there; zero: none.
Spectrum SunOn(const MontageScene& scene, const SurfacePoint& surface) {
  const Daylight& light = scene.natural.light;
  const double cosine = surface.normal.dot(light.sun_direction);
  const Ray to_sun = {surface.position + kSurveyClearance * surface.normal, light.sun_direction};
  if (cosine <= 0 || light.zenith_direction.dot(light.sun_direction) <= 0 ||
      scene.natural_rays.IsOccluded(to_sun)) {
    return Spectrum::Zero();
  }
  return cosine * light.sun_solid_angle * light.sun_radiance;
}

SunPixel Look(const BlockView& view, int column, int row) {
  SunPixel none;
  const auto apparent = MeanOf(view, column, row);
  if (!apparent) return none;
  const double half = (view.block - 1) / 2.0;
  const Eigen::Vector2d pixel(column * view.block + half, row * view.block + half);
  const Ray ray = {view.center, view.local_from_cam * view.sights.Direction(pixel)};
  const auto hit = FindHit(view.scene, ray, World::kSiteOnly);
  if (!hit || view.scene.material_of_polygon[hit->index].specular) return none;
  const auto around = LightAround(view.scene, *hit);
  const Spectrum sun = SunOn(view.scene, hit->surface);
  if (!around || (sun <= 0).all()) return none;
  const NaturalEnvironment& natural = view.scene.natural;
  const SpectralBasis& spectra = natural.spectra;
  const Vector3d color = spectra.RgbFromSpectrum(
      TrueColor(spectra.SpectrumFromRgb(*apparent), natural.air, hit->distance));
  const Vector3d shade = spectra.RgbFromSpectrum(around->before);
  const Vector3d full = spectra.RgbFromSpectrum(around->before + sun);
  if (color.minCoeff() < kDarkest || shade.minCoeff() <= 0) return none;
  const auto log = [](const Vector3d& ratio) { return ratio.array().log().cast<float>().matrix(); };
  return {hit->index, log(color.cwiseQuotient(full)), log(shade.cwiseQuotient(full))};
}

// One channel in blocks as one of the photograph's size, linear between the blocks' middles.
Raster Enlarged(const Raster& blocks, int block, int width, int height) {
  Raster whole(width, height, 1);
  const auto at = [](double value, int count) { return std::clamp(value, 0.0, count - 1.0); };
  for (int y = 0; y < height; ++y) {
    const double v = at((y + 0.5) / block - 0.5, blocks.height);
    const int top = static_cast<int>(v), bottom = std::min(top + 1, blocks.height - 1);
    for (int x = 0; x < width; ++x) {
      const double u = at((x + 0.5) / block - 0.5, blocks.width);
      const int left = static_cast<int>(u), right = std::min(left + 1, blocks.width - 1);
      const double s = u - left, t = v - top;
      *whole.At(x, y) = static_cast<float>(
          (1 - t) * ((1 - s) * *blocks.At(left, top) + s * *blocks.At(right, top)) +
          t * ((1 - s) * *blocks.At(left, bottom) + s * *blocks.At(right, bottom)));
    }
  }
  return whole;
}

}  // namespace

SunShares FindExistingShadows(const MontageScene& scene, const PosedCamera& camera,
                              const Raster& photo, const Foreground* foreground) {
  INSITU_CHECK(photo.width == camera.camera.width() && photo.height == camera.camera.height());
  const double pixels = static_cast<double>(photo.width) * photo.height;
  const BlockView view{scene,
                       photo,
                       foreground,
                       SightMap(camera.camera),
                       camera.cam_from_world.rotation.toRotationMatrix().transpose(),
                       Center(camera.cam_from_world) - scene.natural.scene.origin,
                       static_cast<int>(std::ceil(std::sqrt(pixels / kMostPixels)))};
  std::vector<SunPixel> looks(static_cast<size_t>(view.Columns()) * view.Rows());
  tbb::parallel_for(0, view.Rows(), [&](int row) {
    for (int column = 0; column < view.Columns(); ++column) {
      looks[static_cast<size_t>(row) * view.Columns() + column] = Look(view, column, row);
    }
  });
  SunShares shares = SeparateShadows(view.Columns(), view.Rows(), looks);
  if (view.block == 1) return shares;
  return {Enlarged(shares.share, view.block, photo.width, photo.height),
          Enlarged(shares.sigma, view.block, photo.width, photo.height)};
}

}  // namespace insitu
