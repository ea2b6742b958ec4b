// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs to zoom into: tiles, patches and pixels, from memory and on demand.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibration/tiles/pixel_value.h"

namespace insitu {

inline constexpr int kTileSize = 512;  // [px]

// Level 0 is the photograph; level l is it halved l times, sizes rounded up; the last one fits into
// one tile.
struct PyramidSize {
  int width = 0, height = 0, levels = 0;
};

PyramidSize PyramidSizeOf(int width, int height);

// Pixels are the file's, EXIF's orientation not applied; 16 bits and EXR are shown as 8-bit sRGB.
// Any thread may ask; a photograph is decoded once, however many ask. Each throws InputError: the
// photograph cannot be decoded (names it), or there is no such photograph, tile or pixel.
class PhotoTiles {
 public:
  // What is decoded takes at most about `most_bytes`, of which what was asked for last. Overviews
  // of all but JPEG, which has its own, are kept in the folder `overviews`, if it is named.
  explicit PhotoTiles(std::vector<std::filesystem::path> photos,
                      const std::filesystem::path& overviews = {},
                      size_t most_bytes = size_t{2} << 30);
  ~PhotoTiles();

  int count() const;
  PyramidSize SizeOf(int photo);  // from the header alone

  // JPEG of kTileSize squared; beyond the photograph its edge is repeated.
  std::string Tile(int photo, int level, int x, int y);

  // PNG of the 2 radius + 1 pixels squared around (x, y), lossless; black beyond the photograph.
  std::string Patch(int photo, int x, int y, int radius);

  PixelValue Value(int photo, int x, int y);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace insitu
