// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/picture/render.h"

#include <pmmintrin.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <thread>
#include <tuple>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "renderer/picture/outline.h"
#include "renderer/picture/pixel_rays.h"

namespace insitu {
namespace {

// The noise that a computed pixel lacks: that of its radiance, less what came with the photograph's
// share in it.
Eigen::Vector3d MissingGrain(const Grain& grain, const PixelSum& sum, const Eigen::Vector3d& photo,
                             const Eigen::Vector3d& mean, int x, int y) {
  const Eigen::Array3d site = (sum.rays - sum.building_rays) * photo + sum.change;
  const Eigen::Array3d share = site / (sum.rays * photo.array().max(1e-9));
  const Eigen::Array3d present = share.square() * grain.Variance(photo).array();
  const Eigen::Array3d missing = (grain.Variance(mean).array() - present).max(0).sqrt();
  return missing * UnitGrain(grain, x, y, 0).array();
}

// Of the pixels of a tile.
Outline OutlineIn(const ViewWork& view, const PointSpread& spread, const Tile& tile) {
  const double sigma = std::max(spread.center_sigma, spread.corner_sigma);
  return {view.scene,
          {tile.left, tile.top},
          {tile.right, tile.bottom},
          static_cast<int>(std::ceil(kSpreadReach * sigma)),
          [&view](const Eigen::Vector2d& pixel) { return SightOf(view, pixel); }};
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

void SetLayers(float front, bool is_computed, float* layers) {
  layers[0] = is_computed ? 0 : 1 - front;
  layers[1] = is_computed ? 1 - front : 0;
  layers[2] = front;
}

// The site's surface changes by its reflectance, of which a clipped pixel tells a lower bound.
void CountClipped(const ViewWork& view, const Eigen::Vector3d& computed, int x, int y,
                  TileCounts* counts) {
  if (!view.options.is_clipped || !view.options.is_clipped(x, y)) return;
  const bool is_darker = computed.sum() < view.photo.Rgb(x, y).sum();
  ++(is_darker ? counts->clipped_darkened : counts->clipped_lifted);
}

// What the rays make of a pixel; nullopt: the photograph's stays.
std::optional<Eigen::Vector3d> ComputedPixel(const ViewWork& view, const PixelSum& sum,
                                             bool has_outline, int x, int y) {
  if (!sum.IsChanged()) return std::nullopt;
  const Eigen::Vector3d photo = view.photo.Rgb(x, y), behind = Behind(view, x, y);
  Eigen::Vector3d mean = sum.Mean(behind);
  const double seen = 1 - FrontShare(view, x, y);
  // m F + (1 - m) B of the photograph, with the new B.
  const auto composed = [&] { return seen < 1 ? photo + seen * (mean - behind) : mean; };
  const bool may_stay = sum.building_rays == 0 || has_outline;
  if (may_stay && IsWithinReach(photo, composed(), view.options.reach)) return std::nullopt;
  if (view.options.grain) mean += MissingGrain(*view.options.grain, sum, behind, mean, x, y);
  // Only a photograph of colours beyond Rec. 709 has less than no light of a primary.
  return composed().cwiseMax(photo.cwiseMin(0));
}

// The means of what the rays have summed, and what else the pixel is made of.
void TellLayers(const ViewWork& view, const PixelSum& sum, bool is_computed, int x, int y) {
  LayeredPixel pixel = sum.layered ? *sum.layered : LayeredPixel();
  pixel.seen = 1 - FrontShare(view, x, y);
  pixel.is_computed = is_computed;
  if (sum.rays > 0) {
    pixel.coverage = static_cast<double>(sum.building_rays) / sum.rays;
    for (Eigen::Vector3d& light : pixel.light) light /= sum.rays;
    const Eigen::Array3d mean = sum.Mean(Behind(view, x, y));
    const Eigen::Array3d variance = pixel.ray_error.array() / sum.rays - mean.square();
    pixel.ray_error = (variance.max(0) / std::max(1, sum.rays - 1)).sqrt();
    double met = 0;
    for (auto* shares : {&pixel.polygons, &pixel.materials}) {
      for (auto& [index, share] : *shares) {
        met += share;
        share /= sum.rays;
      }
    }
    if (met > 0) pixel.distance /= met;
    if (!pixel.normal.isZero(0)) pixel.normal.normalize();
  }
  const auto& grain = view.options.grain;
  if (is_computed && grain) {
    const Eigen::Vector3d behind = Behind(view, x, y);
    pixel.grain = MissingGrain(*grain, sum, behind, sum.Mean(behind), x, y);
  }
  view.options.layers(x, y, pixel);
}

// The same with the site's change so many times as large.
std::shared_ptr<LayeredPixel> Scaled(const LayeredPixel& pixel, const Eigen::Array3d& times) {
  auto scaled = std::make_shared<LayeredPixel>(pixel);
  for (size_t part = kSunBlocked; part < kLightParts; ++part) {
    scaled->light[part].array() *= times;
  }
  return scaled;
}

// The rays of the squares of pixels in a tile, each sampled once. The site's change, a share of
// what the photograph shows, is told of the square's first pixel.
class BlockSums {
 public:
  BlockSums(const ViewWork& view, const Tile& tile)
      : view_(view), tile_(tile), size_(view.options.block) {
    across_ = (tile.right - tile.left + size_ - 1) / size_;
    sums_.resize(static_cast<size_t>(across_) * ((tile.bottom - tile.top + size_ - 1) / size_));
  }

  // `rays` is added to where they are sampled.
  PixelSum At(int x, int y, bool near_outline, int64_t* rays) {
    const int u = (x - tile_.left) / size_, v = (y - tile_.top) / size_;
    const int first_x = tile_.left + u * size_, first_y = tile_.top + v * size_;
    std::optional<PixelSum>& sum = sums_[static_cast<size_t>(v) * across_ + u];
    if (!sum) {
      sum = SamplePixel(view_, first_x, first_y, near_outline);
      *rays += sum->rays;
    }
    if (size_ == 1 || sum->change.isZero(0)) return *sum;
    constexpr double kMostTimes = 4;  // a bright pixel beside a dark one
    PixelSum own = *sum;
    const Eigen::Array3d here = Behind(view_, x, y), there = Behind(view_, first_x, first_y);
    const Eigen::Array3d times = (here / there.max(1e-6)).max(0).min(kMostTimes);
    own.change.array() *= times;
    if (own.layered) own.layered = Scaled(*own.layered, times);
    return own;
  }

 private:
  const ViewWork& view_;
  const Tile tile_;
  const int size_;
  int across_ = 0;
  std::vector<std::optional<PixelSum>> sums_;
};

FinishedTile RenderTile(const ViewWork& view, int index) {
  const Tile tile = TileAt(view.photo.width, view.photo.height, index);
  FinishedTile finished;
  finished.index = index;
  std::optional<Outline> outline;
  if (const auto& spread = view.options.point_spread; spread && view.options.block == 1) {
    outline = OutlineIn(view, *spread, tile);
  }
  BlockSums sums(view, tile);
  for (int y = tile.top; y < tile.bottom; ++y) {
    for (int x = tile.left; x < tile.right; ++x) {
      finished.is_computed.push_back(0);
      if (FrontShare(view, x, y) >= 1) {
        if (view.options.layers) TellLayers(view, {}, false, x, y);
        continue;
      }
      const PixelSum sum = sums.At(x, y, outline && outline->IsNear(x, y), &finished.counts.rays);
      const auto computed = ComputedPixel(view, sum, outline.has_value(), x, y);
      if (view.options.layers) TellLayers(view, sum, computed.has_value(), x, y);
      if (!computed) continue;
      ++(sum.building_rays > 0 ? finished.counts.building : finished.counts.changed);
      if (sum.building_rays == 0) CountClipped(view, *computed, x, y, &finished.counts);
      finished.is_computed.back() = 1;
      for (const double value : *computed) finished.rgb.push_back(static_cast<float>(value));
      const double unseen = sum.unseen / sum.rays * (1 - FrontShare(view, x, y));
      finished.unseen.push_back(static_cast<uint8_t>(std::lround(255 * unseen)));
      finished.counts.unseen += finished.unseen.back() > 0;
    }
  }
  return finished;
}

// Which tiles there are to render, those in sight of the building first.
std::vector<int> TilesToRender(const ViewWork& view, const std::vector<FinishedTile>& earlier) {
  const int count = TileCount(view.photo.width, view.photo.height);
  std::vector<char> is_there(count, 0);
  for (const FinishedTile& tile : earlier) is_there.at(tile.index) = 1;
  const InfluenceBox& box = view.scene.building_box;
  const Eigen::Vector3d middle = ((box.low + box.high) / 2).cast<double>().matrix();
  const Eigen::Vector3d to_building = (middle - view.center).normalized();
  std::vector<std::tuple<bool, double, int>> tiles;  // by the angle from its middle
  for (int index = 0; index < count; ++index) {
    if (is_there[index]) continue;
    const Tile tile = TileAt(view.photo.width, view.photo.height, index);
    const Ray ray = SightOf(view, {(tile.left + tile.right) / 2.0, (tile.top + tile.bottom) / 2.0});
    const Eigen::Array3f inverse = ray.direction.cast<float>().array().inverse();
    const bool is_before = !box.IsEmpty() && box.MayMeet(ray.origin.cast<float>().array(), inverse);
    const double angle =
        box.IsEmpty() ? 0 : std::acos(std::clamp(ray.direction.dot(to_building), -1.0, 1.0));
    tiles.emplace_back(!is_before, angle, index);
  }
  std::sort(tiles.begin(), tiles.end());
  std::vector<int> indices;
  for (const auto& [is_beside, angle, index] : tiles) indices.push_back(index);
  return indices;
}

// A picture into which finished tiles are put; different tiles from different threads.
class Assembly {
 public:
  Assembly(const ViewWork& view, RenderResult& result) : view_(view), result_(result) {
    result_.linear = view.photo;
    result_.layers = Raster(view.photo.width, view.photo.height);
    result_.unseen = Raster(view.photo.width, view.photo.height, 1);
    for (int y = 0; y < view.photo.height; ++y) {
      for (int x = 0; x < view.photo.width; ++x) {
        SetLayers(FrontShare(view_, x, y), false, result_.layers.At(x, y));
      }
    }
  }

  void Put(const FinishedTile& finished) {
    const Tile tile = TileAt(view_.photo.width, view_.photo.height, finished.index);
    size_t pixel = 0, sample = 0;
    for (int y = tile.top; y < tile.bottom; ++y) {
      for (int x = tile.left; x < tile.right; ++x) {
        if (!finished.is_computed.at(pixel++)) continue;
        for (int c = 0; c < 3; ++c) result_.linear.At(x, y)[c] = finished.rgb.at(sample++);
        SetLayers(FrontShare(view_, x, y), true, result_.layers.At(x, y));
        const uint8_t unseen = finished.unseen.at(sample / 3 - 1);
        *result_.unseen.At(x, y) = unseen / 255.0F;
        unseen_sum_ += unseen;
      }
    }
    unseen_ += finished.counts.unseen;
    building_ += finished.counts.building;
    changed_ += finished.counts.changed;
    clipped_darkened_ += finished.counts.clipped_darkened;
    clipped_lifted_ += finished.counts.clipped_lifted;
    rays_ += finished.counts.rays;
    ++tiles_;
  }

  void Finish() {
    const int width = view_.photo.width, height = view_.photo.height;
    result_.building_pixels = building_;
    result_.changed_pixels = changed_;
    result_.clipped_darkened = clipped_darkened_;
    result_.clipped_lifted = clipped_lifted_;
    result_.unseen_pixels = unseen_;
    result_.unseen_area = static_cast<double>(unseen_sum_) / 255;
    result_.mean_rays = static_cast<double>(rays_) / (static_cast<double>(width) * height);
    result_.tiles_left = TileCount(width, height) - tiles_;
  }

 private:
  const ViewWork& view_;
  RenderResult& result_;
  std::atomic<long> building_ = 0, changed_ = 0, rays_ = 0;
  std::atomic<long> clipped_darkened_ = 0, clipped_lifted_ = 0;
  std::atomic<long> unseen_ = 0, unseen_sum_ = 0;
  std::atomic<int> tiles_ = 0;
};

// One after the other on every thread, until all are done or it is stopped.
void RenderTiles(const ViewWork& view, const std::vector<int>& indices, int threads,
                 const RenderCourse& course, Assembly* assembly) {
  std::atomic<size_t> next = 0;
  const auto work = [&](int) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    for (size_t i = next++; i < indices.size(); i = next++) {
      if (course.stops && course.stops()) return;
      const FinishedTile finished = RenderTile(view, indices[i]);
      assembly->Put(finished);
      if (course.tile_done) course.tile_done(finished);
    }
  };
  tbb::parallel_for(0, threads, work, tbb::simple_partitioner());
}

}  // namespace

RenderResult RenderMontage(const MontageScene& scene, const PosedCamera& camera,
                           const Raster& photo, const RenderOptions& options,
                           const RenderCourse& course) {
  options.Check();
  INSITU_CHECK(photo.width == camera.camera.width() && photo.height == camera.camera.height());
  INSITU_CHECK(!options.foreground || (options.foreground->share.width == photo.width &&
                                       options.foreground->share.height == photo.height));
  INSITU_CHECK(!options.sun_share || (options.sun_share->width == photo.width &&
                                      options.sun_share->height == photo.height));
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int threads = options.threads > 0 ? options.threads : cores;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const ViewWork view = PrepareView(scene, camera, photo, options);
  RenderResult result;
  Assembly assembly(view, result);
  for (const FinishedTile& tile : course.earlier) assembly.Put(tile);
  RenderTiles(view, TilesToRender(view, course.earlier), threads, course, &assembly);
  assembly.Finish();
  return result;
}

}  // namespace insitu
