// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/picture/pixel_rays.h"

#include <algorithm>
#include <optional>

#include "renderer/trace/trace.h"

namespace insitu {

ViewWork PrepareView(const MontageScene& scene, const PosedCamera& camera, const Raster& photo,
                     const RenderOptions& options) {
  const Eigen::Vector3d center = Center(camera.cam_from_world) - scene.natural.scene.origin;
  return {scene,
          photo,
          options,
          SightMap(camera.camera),
          camera.cam_from_world.rotation.toRotationMatrix().transpose(),
          center};
}

float FrontShare(const ViewWork& view, int x, int y) {
  return view.options.foreground ? *view.options.foreground->share.At(x, y) : 0;
}

Eigen::Vector3d Behind(const ViewWork& view, int x, int y) {
  return view.options.foreground ? view.options.foreground->behind.Rgb(x, y) : view.photo.Rgb(x, y);
}

Ray SightOf(const ViewWork& view, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d last(view.photo.width - 0.5, view.photo.height - 0.5);
  const Eigen::Vector2d inside = pixel.cwiseMax(-0.5).cwiseMin(last);
  return {view.center, view.local_from_cam * view.sights.Direction(inside)};
}

namespace {

// [px]; nullopt: ideal.
std::optional<double> SpreadSigma(const ViewWork& view, int x, int y) {
  if (!view.options.point_spread) return std::nullopt;
  return view.options.point_spread->SigmaAt({x, y}, view.photo.width, view.photo.height);
}

// `rgb`: what the ray brings in all.
void AddParts(const SpectralBasis& spectra, const RayParts& parts, const Eigen::Vector3d& rgb,
              LayeredPixel* sum) {
  sum->ray_error += rgb.cwiseAbs2();
  for (int part = 0; part < kLightParts; ++part) {
    sum->light[part] += spectra.RgbFromSpectrum(parts.light[part]);
  }
  if (!parts.has_hit) return;
  sum->distance += parts.hit.distance;
  sum->normal += parts.hit.normal;
  if (parts.hit.is_building) {
    sum->materials[parts.hit.material] += 1;
  } else {
    sum->polygons[parts.hit.polygon] += 1;
  }
}

void AddRay(const ViewWork& view, const PixelSampler& sampler, int x, int y,
            const std::optional<double>& sigma, PixelSum& sum) {
  const int block = view.options.block;
  const Eigen::Vector2d offset =
      sigma && block == 1 ? sampler.Spread(sum.rays, *sigma)
                          : block * (sampler.InPixel(sum.rays) + Eigen::Vector2d(0.5, 0.5)) -
                                Eigen::Vector2d(0.5, 0.5);
  PrimaryRay primary;
  primary.ray = SightOf(view, Eigen::Vector2d(x, y) + offset);
  primary.apparent_rgb = Behind(view, x, y);
  primary.light = ChooseLightDirections(view.scene, sampler.OnDisc(sum.rays), sum.rays,
                                        sampler.OnFacet(sum.rays), sampler.Seed(sum.rays));
  if (view.options.sun_share) primary.light.sun_share = *view.options.sun_share->At(x, y);
  double unseen = 0;
  primary.light.unseen = &unseen;
  std::optional<RayParts> parts;
  if (view.options.layers) primary.light.parts = &parts.emplace();
  const RayOutcome outcome = TracePrimary(view.scene, primary);
  ++sum.rays;
  if (parts) {
    if (!sum.layered) sum.layered = std::make_shared<LayeredPixel>();
    const Eigen::Vector3d brings =
        outcome.hits_building ? outcome.rgb : Eigen::Vector3d(primary.apparent_rgb + outcome.rgb);
    AddParts(view.scene.natural.spectra, *parts, brings, sum.layered.get());
  }
  sum.unseen += std::min(1.0, unseen);
  if (outcome.hits_building) {
    ++sum.building_rays;
    sum.building += outcome.rgb;
    sum.statistics.Add(outcome.rgb);
  } else {
    sum.change += outcome.rgb;
    sum.statistics.Add(primary.apparent_rgb + outcome.rgb);
  }
}

bool IsEnough(const RenderOptions& options, const PixelSum& sum, bool near_outline) {
  if (sum.rays < options.fewest_rays) return false;
  const bool is_mixed = sum.building_rays > 0 && sum.building_rays < sum.rays;
  if (options.point_spread && (near_outline || is_mixed)) {
    // The first rays may all miss what spreads into the pixel.
    if (sum.rays < options.most_rays) return false;
    return sum.rays >= options.outline_rays || sum.statistics.StandardError() <= options.tolerance;
  }
  return sum.rays >= options.most_rays || !sum.IsChanged() ||
         sum.statistics.StandardError() <= options.tolerance;
}

}  // namespace

PixelSum SamplePixel(const ViewWork& view, int x, int y, bool near_outline) {
  const PixelSampler sampler(x, y);
  const std::optional<double> sigma = SpreadSigma(view, x, y);
  PixelSum sum;
  do {
    for (int i = 0; i < 4; ++i) AddRay(view, sampler, x, y, sigma, sum);
  } while (!IsEnough(view.options, sum, near_outline));
  return sum;
}

}  // namespace insitu
