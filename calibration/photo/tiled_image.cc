// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/tiled_image.h"

#include <OpenImageIO/imagecache.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr int kTileOfRows = 64;  // of files that are no tiles

OIIO::ImageCache& Tiles() {
  struct Owner {
    OIIO::ImageCache* cache = OIIO::ImageCache::create(false);
    Owner() {
      cache->attribute("max_memory_MB", kTileMegabytes);
      cache->attribute("autotile", kTileOfRows);
      cache->attribute("autoscanline", 1);
      cache->attribute("forcefloat", 1);
    }
    ~Owner() { OIIO::ImageCache::destroy(cache); }
  };
  static const Owner owner;
  return *owner.cache;
}

}  // namespace

TiledImage::TiledImage(const std::filesystem::path& file, const Eigen::Vector3f& factor)
    : file_(file), factor_(factor) {
  OIIO::ImageCache& tiles = Tiles();
  const OIIO::ustring name(file.string());
  tiles.invalidate(name);  // it may have been written anew
  OIIO::ImageCache::ImageHandle* handle = tiles.get_image_handle(name);
  OIIO::ImageSpec spec;
  if (handle == nullptr || !tiles.get_imagespec(handle, nullptr, spec)) {
    throw InputError(file, "cannot be read: " + tiles.geterror());
  }
  if (spec.nchannels != 3) {
    throw InputError(file, "has " + std::to_string(spec.nchannels) + " channels, expected 3");
  }
  handle_ = handle;
  width_ = spec.width;
  height_ = spec.height;
  tile_width_ = spec.tile_width;
  tile_height_ = spec.tile_height;
}

Eigen::Vector3d TiledImage::Rgb(int x, int y) const {
  OIIO::ImageCache& tiles = Tiles();
  auto* handle = static_cast<OIIO::ImageCache::ImageHandle*>(handle_);
  OIIO::ImageCache::Tile* tile = tiles.get_tile(handle, nullptr, 0, 0, x, y, 0);
  OIIO::TypeDesc format;
  const void* pixels = tile == nullptr ? nullptr : tiles.tile_pixels(tile, format);
  if (pixels == nullptr) {
    throw std::runtime_error(file_.string() + ": cannot be read any more: " + tiles.geterror());
  }
  const std::ptrdiff_t row = y % tile_height_, column = x % tile_width_;
  const float* at = static_cast<const float*>(pixels) + 3 * (row * tile_width_ + column);
  const Eigen::Vector3f rgb = Eigen::Map<const Eigen::Vector3f>(at).cwiseProduct(factor_);
  tiles.release_tile(tile);
  return rgb.cast<double>();
}

Eigen::Vector3d TiledImage::At(const Eigen::Vector2d& pixel) const {
  const double x = std::clamp(pixel.x(), 0.0, width_ - 1.0);
  const double y = std::clamp(pixel.y(), 0.0, height_ - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, width_ - 1), y1 = std::min(y0 + 1, height_ - 1);
  const double u = x - x0, v = y - y0;
  const Eigen::Vector3d above = (1 - u) * Rgb(x0, y0) + u * Rgb(x1, y0);
  const Eigen::Vector3d below = (1 - u) * Rgb(x0, y1) + u * Rgb(x1, y1);
  return (1 - v) * above + v * below;
}

}  // namespace insitu
