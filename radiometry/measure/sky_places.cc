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

// A photograph in blocks.
class Blocks {
 public:
  Blocks(const Photograph& photo, const PosedCamera& posed, const SceneGeometry& scene,
         const RayScene& rays, const Raster* matte)
      : photo_(photo), posed_(posed), scene_(scene), rays_(rays), matte_(matte) {
    size_ = std::max(kSmallestBlock, photo.linear.width / kBlocksAcross);
    columns_ = photo.linear.width / size_;
    rows_ = photo.linear.height / size_;
    MarkOpen();
  }

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int size() const { return size_; }

  Eigen::Vector3d DirectionOf(const Eigen::Vector2d& pixel) const {
    return posed_.cam_from_world.rotation.conjugate() * posed_.camera.Unproject(pixel);
  }
  Eigen::Vector2d MiddleOf(int column, int row) const {
    return Eigen::Vector2d(column + 0.5, row + 0.5) * size_ - Eigen::Vector2d::Constant(0.5);
  }

  // Its mean colour if it may be sky.
  std::optional<Eigen::Vector3d> ColorOf(int column, int row) const {
    for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y) {
      for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x) {
        if (!is_open_[y * columns_ + x]) return std::nullopt;
      }
    }
    return EvenColor(column * size_, row * size_);
  }

 private:
  bool SeesSky(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d direction = DirectionOf(pixel);
    if (scene_.zenith.unit.dot(direction) < kLowest) return false;
    return !rays_.IsOccluded({Center(posed_.cam_from_world) - scene_.origin, direction});
  }

  // Blocks whose corners and middle see no polygon.
  void MarkOpen() {
    const int corner_count = (columns_ + 1) * (rows_ + 1), block_count = columns_ * rows_;
    std::vector<bool> corners(corner_count);
    for (int i = 0; i < corner_count; ++i) {
      const Eigen::Vector2d corner(i % (columns_ + 1), i / (columns_ + 1));
      corners[i] = SeesSky(corner * size_ - Eigen::Vector2d::Constant(0.5));
    }
    is_open_.resize(block_count);
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const int corner = row * (columns_ + 1) + column;
        is_open_[row * columns_ + column] =
            corners[corner] && corners[corner + 1] && corners[corner + columns_ + 1] &&
            corners[corner + columns_ + 2] && SeesSky(MiddleOf(column, row));
      }
    }
  }

  std::optional<Eigen::Vector3d> EvenColor(int left, int top) const {
    Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
    int count = 0;
    const int step = std::max(1, size_ / kPixelsAcross);
    for (int y = top; y < top + size_; y += step) {
      for (int x = left; x < left + size_; x += step) {
        if (IsClipped(photo_, x, y) || (matte_ && *matte_->At(x, y) > 0)) return std::nullopt;
        const Eigen::Array3d rgb = photo_.linear.Rgb(x, y).array();
        sum += rgb;
        squares += rgb.square();
        ++count;
      }
    }
    const Eigen::Array3d mean = sum / count, variance = squares / count - mean.square();
    if (!(mean > 0).all() || (variance > (kEvenBlock * mean).square()).any()) return std::nullopt;
    return mean;
  }

  const Photograph& photo_;
  const PosedCamera& posed_;
  const SceneGeometry& scene_;
  const RayScene& rays_;
  const Raster* matte_;
  int size_ = 0, columns_ = 0, rows_ = 0;
  std::vector<bool> is_open_;
};

bool HoldsSample(const Blocks& blocks, const Eigen::Vector2i& block, const Eigen::Vector3d& rgb,
                 int photo, const std::vector<PixelSample>& horizon) {
  const Eigen::Vector2d middle = blocks.MiddleOf(block.x(), block.y());
  return std::ranges::any_of(horizon, [&](const PixelSample& sample) {
    const double apart = (sample.pixel - middle).cwiseAbs().maxCoeff() / blocks.size();
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

std::vector<SkyRegion> SkyRegionsIn(const Photograph& photo, int index, const SceneGeometry& scene,
                                    const RayScene& rays, const Raster* matte,
                                    const std::vector<PixelSample>& horizon) {
  const Blocks blocks(photo, scene.cameras[index], scene, rays, matte);
  const int columns = blocks.columns(), count = columns * blocks.rows();
  std::vector<std::optional<Eigen::Vector3d>> colors(count);
  for (int i = 0; i < count; ++i) colors[i] = blocks.ColorOf(i % columns, i / columns);
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
      region.places.push_back({blocks.DirectionOf(blocks.MiddleOf(x, y)), rgb});
      region.is_marked = region.is_marked || HoldsSample(blocks, {x, y}, rgb, index, horizon);
      for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        const int next = block + dy * columns + dx;
        if (x + dx < 0 || x + dx >= columns || y + dy < 0 || y + dy >= blocks.rows()) continue;
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
