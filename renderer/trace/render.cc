// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/render.h"

#include <pmmintrin.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

#include <atomic>
#include <thread>

#include "calibration/files/error.h"
#include "calibration/lens/sight_map.h"
#include "calibration/photo/photograph.h"
#include "renderer/trace/sampling.h"
#include "renderer/trace/trace.h"

namespace insitu {
namespace {

struct Tile {
  int left, top, right, bottom;
};

Tile TileAt(const Raster& photo, int index) {
  const int columns = (photo.width + kTileSize - 1) / kTileSize;
  const int left = index % columns * kTileSize;
  const int top = index / columns * kTileSize;
  return {left, top, std::min(left + kTileSize, photo.width),
          std::min(top + kTileSize, photo.height)};
}

// One view being rendered; all of it is read only while tiles are at work.
struct ViewWork {
  const MontageScene& scene;
  const Raster& photo;
  const RenderOptions& options;
  SightMap sights;
  Eigen::Matrix3d local_from_cam;
  Eigen::Vector3d center;  // [m], local
};

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

// The rays of one pixel, gathered.
struct PixelSum {
  int rays = 0, building_rays = 0;
  Eigen::Vector3d building = Eigen::Vector3d::Zero();  // sum of the building's radiances
  Eigen::Vector3d change = Eigen::Vector3d::Zero();    // sum of the site's changes
  ColorStatistics statistics;

  bool IsChanged() const { return building_rays > 0 || !change.isZero(0); }
  Eigen::Vector3d Mean(const Eigen::Vector3d& photo_rgb) const {
    const Eigen::Vector3d site = (rays - building_rays) * photo_rgb + change;
    return (building + site) / rays;
  }
};

void AddRay(const ViewWork& view, const PixelSampler& sampler, int x, int y, PixelSum& sum) {
  const Eigen::Vector2d pixel = Eigen::Vector2d(x, y) + sampler.InPixel(sum.rays);
  PrimaryRay primary;
  primary.ray.origin = view.center;
  primary.ray.direction = view.local_from_cam * view.sights.Direction(pixel);
  primary.apparent_rgb = view.photo.Rgb(x, y);
  primary.light = ChooseLightDirections(view.scene, sampler.OnDisc(sum.rays), sum.rays);
  const RayOutcome outcome = TracePrimary(view.scene, primary);
  ++sum.rays;
  if (outcome.hits_building) {
    ++sum.building_rays;
    sum.building += outcome.rgb;
    sum.statistics.Add(outcome.rgb);
  } else {
    sum.change += outcome.rgb;
    sum.statistics.Add(primary.apparent_rgb + outcome.rgb);
  }
}

PixelSum SamplePixel(const ViewWork& view, int x, int y) {
  const PixelSampler sampler(x, y);
  PixelSum sum;
  do {
    for (int i = 0; i < 4; ++i) AddRay(view, sampler, x, y, sum);
  } while (sum.rays < view.options.fewest_rays ||
           (sum.rays < view.options.most_rays && sum.IsChanged() &&
            sum.statistics.StandardError() > view.options.tolerance));
  return sum;
}

// Whether a change is too small to be seen in any channel.
bool IsWithinReach(const Eigen::Vector3d& before, const Eigen::Vector3d& after, double reach) {
  for (int c = 0; c < 3; ++c) {
    const double change =
        SrgbFromLinear(std::max(0.0, after[c])) - SrgbFromLinear(std::max(0.0, before[c]));
    if (std::abs(change) * 255 > reach) return false;
  }
  return true;
}

struct Counts {
  std::atomic<long> building = 0, changed = 0, rays = 0;
};

void RenderTile(const ViewWork& view, const Tile& tile, Raster& result, Counts& counts) {
  for (int y = tile.top; y < tile.bottom; ++y) {
    for (int x = tile.left; x < tile.right; ++x) {
      const PixelSum sum = SamplePixel(view, x, y);
      counts.rays += sum.rays;
      if (!sum.IsChanged()) continue;  // the photograph's pixel stays
      const Eigen::Vector3d photo = view.photo.Rgb(x, y), mean = sum.Mean(photo);
      if (sum.building_rays == 0 && IsWithinReach(photo, mean, view.options.reach)) continue;
      ++(sum.building_rays > 0 ? counts.building : counts.changed);
      result.SetRgb(x, y, mean.cwiseMax(0));
    }
  }
}

}  // namespace

int TileCount(const Raster& photo) {
  return ((photo.width + kTileSize - 1) / kTileSize) * ((photo.height + kTileSize - 1) / kTileSize);
}

void RenderOptions::Check() const {
  INSITU_CHECK(fewest_rays >= 4 && fewest_rays % 4 == 0);
  INSITU_CHECK(most_rays >= fewest_rays && most_rays % 4 == 0);
  INSITU_CHECK(tolerance > 0);
  INSITU_CHECK(reach >= 0);
  INSITU_CHECK(threads >= 0);
}

RenderResult RenderMontage(const MontageScene& scene, const PosedCamera& camera,
                           const Raster& photo, const RenderOptions& options,
                           const std::function<void()>& tile_done) {
  options.Check();
  INSITU_CHECK(photo.width == camera.camera.width() && photo.height == camera.camera.height());
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  options.threads > 0 ? options.threads : cores);
  const ViewWork view = PrepareView(scene, camera, photo, options);
  RenderResult result;
  result.linear = photo;
  Counts counts;
  tbb::parallel_for(0, TileCount(photo), [&](int index) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    RenderTile(view, TileAt(photo, index), result.linear, counts);
    if (tile_done) tile_done();
  });
  result.building_pixels = counts.building;
  result.changed_pixels = counts.changed;
  result.mean_rays = static_cast<double>(counts.rays) / (photo.width * photo.height);
  return result;
}

}  // namespace insitu
