// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/photo_tiles.h"

#include <algorithm>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "calibration/files/error_at.h"
#include "calibration/photo/photograph.h"
#include "calibration/tiles/overview_files.h"
#include "calibration/tiles/photo_cache.h"
#include "calibration/tiles/shown_image.h"

namespace insitu {
namespace {

constexpr int kOverview = 3;      // the level that ReadEighthOfPhotograph makes
constexpr int kMostRadius = 512;  // [px]

int TileCount(int size, int level) {
  const int level_size = static_cast<int>((int64_t{size} + (int64_t{1} << level) - 1) >> level);
  return (level_size + kTileSize - 1) / kTileSize;
}

}  // namespace

struct PhotoTiles::Parts {
  Parts(std::vector<std::filesystem::path> paths, const std::filesystem::path& folder,
        size_t most_bytes)
      : photos(std::move(paths)),
        overviews(folder),
        cache(most_bytes),
        sizes(photos.size()),
        colors(photos.size()) {}

  const std::filesystem::path& PathOf(int photo) const {
    if (photo >= 0 && photo < static_cast<int>(photos.size())) return photos[photo];
    throw InputError("photograph " + std::to_string(photo),
                     "is not there, expected one of " + std::to_string(photos.size()));
  }

  void RequirePixel(int photo, int x, int y) {
    const PyramidSize size = SizeOf(photo);
    if (x >= 0 && y >= 0 && x < size.width && y < size.height) return;
    throw InputError(PathOf(photo), "has no pixel (" + std::to_string(x) + ", " +
                                        std::to_string(y) + "), it is " +
                                        SizeText(size.width, size.height));
  }

  PyramidSize SizeOf(int photo) {
    const std::filesystem::path& path = PathOf(photo);
    {
      const std::lock_guard lock(mutex);
      if (sizes[photo]) return *sizes[photo];
    }
    const Eigen::Vector2i size = ReadPhotographSize(path);
    const std::lock_guard lock(mutex);
    sizes[photo] = PyramidSizeOf(size.x(), size.y());
    return *sizes[photo];
  }

  ColorSpace ColorOf(int photo) {
    const std::filesystem::path& path = PathOf(photo);
    {
      const std::lock_guard lock(mutex);
      if (colors[photo]) return *colors[photo];
    }
    const ColorSpace color = ReadPhotographColor(path);
    const std::lock_guard lock(mutex);
    colors[photo] = color;
    return color;
  }

  // A photograph changed meanwhile, or its header lies: its tiles would be others than announced.
  std::shared_ptr<PhotoPyramid> Decoded(int photo, cv::Mat image, int level) {
    const PyramidSize size = SizeOf(photo);
    const int step = 1 << level;
    if (image.cols != (size.width + step - 1) / step ||
        image.rows != (size.height + step - 1) / step) {
      throw ErrorAt({PathOf(photo)},
                    Sentence("photoOther", "has another size than before, expected {size}",
                             {{"size", SizeText(size.width, size.height)}}));
    }
    return std::make_shared<PhotoPyramid>(std::move(image), level);
  }

  std::shared_ptr<PhotoPyramid> Whole(int photo) {
    return cache.Get({photo, false},
                     [&] { return Decoded(photo, ReadShownPhotograph(PathOf(photo)), 0); });
  }

  // The one that was kept, or that can be read faster than the whole, else of the whole. A JPEG's
  // own needs no keeping.
  cv::Mat Overview(int photo) {
    const std::filesystem::path& path = PathOf(photo);
    cv::Mat eighth = overviews.Read(path);
    if (!eighth.empty()) return eighth;
    eighth = ReadEighthOfPhotograph(path);
    if (eighth.empty()) eighth = Whole(photo)->Level(kOverview);
    if (!IsJpeg(path)) overviews.Keep(path, eighth);
    return eighth;
  }

  cv::Mat LevelOf(int photo, int level) {
    if (level < kOverview) return Whole(photo)->Level(level);
    const auto overview =
        cache.Get({photo, true}, [&] { return Decoded(photo, Overview(photo), kOverview); });
    return overview->Level(level);
  }

  const std::vector<std::filesystem::path> photos;
  const OverviewFiles overviews;
  PhotoCache cache;
  std::mutex mutex;  // for the next one
  std::vector<std::optional<PyramidSize>> sizes;
  std::vector<std::optional<ColorSpace>> colors;
};

PyramidSize PyramidSizeOf(int width, int height) {
  PyramidSize size{width, height, 1};
  while (TileCount(std::max(width, height), size.levels - 1) > 1) ++size.levels;
  return size;
}

PhotoTiles::PhotoTiles(std::vector<std::filesystem::path> photos,
                       const std::filesystem::path& overviews, size_t most_bytes)
    : parts_(std::make_unique<Parts>(std::move(photos), overviews, most_bytes)) {}

PhotoTiles::~PhotoTiles() = default;

int PhotoTiles::count() const { return static_cast<int>(parts_->photos.size()); }

PyramidSize PhotoTiles::SizeOf(int photo) { return parts_->SizeOf(photo); }

std::string PhotoTiles::Tile(int photo, int level, int x, int y) {
  const PyramidSize size = parts_->SizeOf(photo);
  if (level < 0 || level >= size.levels || x < 0 || y < 0 || x >= TileCount(size.width, level) ||
      y >= TileCount(size.height, level)) {
    throw InputError(parts_->PathOf(photo), "has no tile (" + std::to_string(x) + ", " +
                                                std::to_string(y) + ") of level " +
                                                std::to_string(level));
  }
  const cv::Rect wanted(x * kTileSize, y * kTileSize, kTileSize, kTileSize);
  return EncodedTile(
      CutOut(parts_->LevelOf(photo, level), parts_->ColorOf(photo), wanted, cv::BORDER_REPLICATE),
      TileCoding::kJpeg);
}

std::string PhotoTiles::Patch(int photo, int x, int y, int radius) {
  parts_->RequirePixel(photo, x, y);
  if (radius < 0 || radius > kMostRadius) {
    throw InputError(parts_->PathOf(photo), "a patch of radius " + std::to_string(radius) +
                                                ", expected 0 to " + std::to_string(kMostRadius));
  }
  const cv::Rect wanted(x - radius, y - radius, 2 * radius + 1, 2 * radius + 1);
  return EncodedTile(
      CutOut(parts_->Whole(photo)->Level(0), parts_->ColorOf(photo), wanted, cv::BORDER_CONSTANT),
      TileCoding::kPng);
}

PixelValue PhotoTiles::Value(int photo, int x, int y) {
  parts_->RequirePixel(photo, x, y);
  return PixelValueAt(parts_->Whole(photo)->Level(0), parts_->ColorOf(photo), x, y);
}

}  // namespace insitu
