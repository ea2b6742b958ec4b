// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/sky_places.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace insitu {
namespace {

constexpr int kBlocksAcross = 96;     // a photograph
constexpr int kSmallestBlock = 4;     // [px]
constexpr int kPixelsAcross = 8;      // of a block that are looked at
constexpr double kEvenBlock = 0.05;   // relative standard deviation within a block
constexpr double kSmooth = 0.08;      // |ln| of the ratio of neighbours
constexpr double kLowest = 0.0175;    // sine of the height above the horizon: one degree
constexpr size_t kFewestBlocks = 12;  // of a region
constexpr int kNear = 2;              // [blocks] from a horizon sample
// |ln| of the ratio of a region's place to the nearest of the sky, and its growth with their angle.
constexpr double kSameColor = 0.1, kLooser = 0.3, kMostDifferent = 0.35;

double LogRatio(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a.array() / b.array()).log().abs().maxCoeff();
}

Eigen::Vector2d MiddleOf(const SkyBlocks& blocks, int column, int row) {
  return Eigen::Vector2d(column + 0.5, row + 0.5) * blocks.size - Eigen::Vector2d::Constant(0.5);
}

std::optional<Eigen::Vector3d> EvenColor(const Photograph& photo, const Raster* matte, int size,
                                         int left, int top) {
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
  int count = 0;
  const int step = std::max(1, size / kPixelsAcross);
  for (int y = top; y < top + size; y += step) {
    for (int x = left; x < left + size; x += step) {
      if (IsClipped(photo, x, y) || (matte && *matte->At(x, y) > 0)) return std::nullopt;
      const Eigen::Array3d rgb = photo.linear.Rgb(x, y).array();
      sum += rgb;
      squares += rgb.square();
      ++count;
    }
  }
  const Eigen::Array3d mean = sum / count, variance = squares / count - mean.square();
  if (!(mean > 0).all() || (variance > (kEvenBlock * mean).square()).any()) return std::nullopt;
  return mean;
}

// Which blocks of a photograph are open to the sky.
class OpenBlocks {
 public:
  OpenBlocks(const SkyBlocks& blocks, const PosedCamera& posed, const SceneGeometry& scene,
             const RayScene& rays)
      : blocks_(blocks),
        world_from_cam_(posed.cam_from_world.rotation.conjugate()),
        center_(Center(posed.cam_from_world) - scene.origin),
        zenith_(scene.zenith.unit),
        rays_(rays) {
    MarkOpen();
  }

  // Its mean colour if it may be sky.
  std::optional<Eigen::Vector3d> ColorOf(int block) const {
    const int column = block % blocks_.columns, row = block / blocks_.columns;
    for (int y = std::max(0, row - 1); y <= std::min(blocks_.rows - 1, row + 1); ++y) {
      for (int x = std::max(0, column - 1); x <= std::min(blocks_.columns - 1, column + 1); ++x) {
        if (!is_open_[y * blocks_.columns + x]) return std::nullopt;
      }
    }
    return blocks_.colors[block];
  }

  Eigen::Vector3d DirectionOf(int block) const { return world_from_cam_ * blocks_.middles[block]; }

 private:
  bool SeesSky(const Eigen::Vector3d& in_cam) const {
    const Eigen::Vector3d direction = world_from_cam_ * in_cam;
    if (zenith_.dot(direction) < kLowest) return false;
    return !rays_.IsOccluded({center_, direction});
  }

  // Blocks whose corners and middle see no polygon.
  void MarkOpen() {
    const int columns = blocks_.columns, block_count = columns * blocks_.rows;
    std::vector<bool> corners;
    for (const Eigen::Vector3d& corner : blocks_.corners) corners.push_back(SeesSky(corner));
    is_open_.resize(block_count);
    for (int block = 0; block < block_count; ++block) {
      const int corner = block / columns * (columns + 1) + block % columns;
      is_open_[block] = corners[corner] && corners[corner + 1] && corners[corner + columns + 1] &&
                        corners[corner + columns + 2] && SeesSky(blocks_.middles[block]);
    }
  }

  const SkyBlocks& blocks_;
  const Eigen::Quaterniond world_from_cam_;
  const Eigen::Vector3d center_;  // local [m]
  const Eigen::Vector3d zenith_;
  const RayScene& rays_;
  std::vector<bool> is_open_;
};

bool HoldsSample(const SkyBlocks& blocks, const Eigen::Vector2i& block, const Eigen::Vector3d& rgb,
                 int photo, const std::vector<PixelSample>& horizon) {
  const Eigen::Vector2d middle = MiddleOf(blocks, block.x(), block.y());
  return std::ranges::any_of(horizon, [&](const PixelSample& sample) {
    const double apart = (sample.pixel - middle).cwiseAbs().maxCoeff() / blocks.size;
    return sample.photo == photo && apart <= kNear && (sample.rgb.array() > 0).all() &&
           LogRatio(sample.rgb, rgb) <= kSameColor;
  });
}

// Some of its places, spread over it.
std::vector<SkyPlace> Some(const SkyRegion& region) {
  constexpr size_t kMost = 200;
  std::vector<SkyPlace> some;
  const size_t step = region.places.size() / kMost + 1;
  for (size_t i = 0; i < region.places.size(); i += step) some.push_back(region.places[i]);
  return some;
}

// By the closest pair of its places and those of the sky.
bool LooksLikeSky(const SkyRegion& region, const std::vector<SkyPlace>& sky) {
  double closest = -1;
  const SkyPlace *here = nullptr, *there = nullptr;
  const std::vector<SkyPlace> some = Some(region);
  for (const SkyPlace& place : some) {
    for (const SkyPlace& other : sky) {
      const double cosine = place.direction.dot(other.direction);
      if (cosine <= closest) continue;
      closest = cosine;
      here = &place;
      there = &other;
    }
  }
  const double angle = std::acos(std::min(1.0, closest));
  return here &&
         LogRatio(here->rgb, there->rgb) <= std::min(kMostDifferent, kSameColor + kLooser * angle);
}

}  // namespace

SkyBlocks SkyBlocksOf(const Photograph& photo, const Camera& camera, const Raster* matte) {
  SkyBlocks blocks;
  blocks.size = std::max(kSmallestBlock, photo.linear.width / kBlocksAcross);
  blocks.columns = photo.linear.width / blocks.size;
  blocks.rows = photo.linear.height / blocks.size;
  for (int row = 0; row <= blocks.rows; ++row) {
    for (int column = 0; column <= blocks.columns; ++column) {
      const Eigen::Vector2d corner = Eigen::Vector2d(column, row) * blocks.size;
      blocks.corners.push_back(camera.Unproject(corner - Eigen::Vector2d::Constant(0.5)));
      if (row == blocks.rows || column == blocks.columns) continue;
      blocks.middles.push_back(camera.Unproject(MiddleOf(blocks, column, row)));
      blocks.colors.push_back(
          EvenColor(photo, matte, blocks.size, column * blocks.size, row * blocks.size));
    }
  }
  return blocks;
}

std::vector<SkyRegion> SkyRegionsIn(const SkyBlocks& blocks, int index, const SceneGeometry& scene,
                                    const RayScene& rays, const std::vector<PixelSample>& horizon) {
  const OpenBlocks open(blocks, scene.cameras[index], scene, rays);
  const int columns = blocks.columns, count = columns * blocks.rows;
  std::vector<std::optional<Eigen::Vector3d>> colors(count);
  for (int i = 0; i < count; ++i) colors[i] = open.ColorOf(i);
  std::vector<SkyRegion> regions;
  std::vector<bool> is_taken(count);
  for (int start = 0; start < count; ++start) {
    if (!colors[start] || is_taken[start]) continue;
    SkyRegion region{index, false, {}};
    std::vector<int> waiting = {start};
    is_taken[start] = true;
    while (!waiting.empty()) {
      const int block = waiting.back(), x = block % columns, y = block / columns;
      waiting.pop_back();
      const Eigen::Vector3d& rgb = *colors[block];
      region.places.push_back({open.DirectionOf(block), rgb});
      region.is_marked = region.is_marked || HoldsSample(blocks, {x, y}, rgb, index, horizon);
      for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        const int next = block + dy * columns + dx;
        if (x + dx < 0 || x + dx >= columns || y + dy < 0 || y + dy >= blocks.rows) continue;
        if (is_taken[next] || !colors[next] || LogRatio(rgb, *colors[next]) > kSmooth) continue;
        is_taken[next] = true;
        waiting.push_back(next);
      }
    }
    if (region.is_marked || region.places.size() >= kFewestBlocks) {
      regions.push_back(std::move(region));
    }
  }
  return regions;
}

std::vector<SkyRegion> SkyAmong(std::vector<SkyRegion> regions) {
  std::vector<SkyRegion> sky;
  std::vector<SkyPlace> known;
  const auto take = [&](const auto& is_sky) {
    const size_t before = sky.size();
    for (auto region = regions.begin(); region != regions.end();) {
      if (!is_sky(*region)) {
        ++region;
        continue;
      }
      std::ranges::copy(Some(*region), std::back_inserter(known));
      sky.push_back(std::move(*region));
      region = regions.erase(region);
    }
    return sky.size() > before;
  };
  take([](const SkyRegion& region) { return region.is_marked; });
  while (take([&](const SkyRegion& region) { return LooksLikeSky(region, known); })) {
  }
  return sky;
}

}  // namespace insitu
