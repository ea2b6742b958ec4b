// SPDX-License-Identifier: GPL-3.0-or-later
// The tiles of a render, and one of them as it comes out: all that a render need not do again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace insitu {

constexpr int kRenderTile = 32;  // [px], the side of a tile

// [left, right) x [top, bottom) of a picture [px].
struct Tile {
  int left = 0, top = 0, right = 0, bottom = 0;
  int pixels() const { return (right - left) * (bottom - top); }
};

// Tiles count row by row from the picture's top left corner, those at its right and lower border
// are smaller.
int TileCount(int width, int height);
Tile TileAt(int width, int height, int index);

struct TileCounts {
  int64_t building = 0;  // pixels of which some ray hits the building
  int64_t changed = 0;   // other pixels that differ from the photograph
  // Of these, pixels that are clipped in the photograph.
  int64_t clipped_darkened = 0, clipped_lifted = 0;
  int64_t unseen = 0;  // pixels with some share that no photograph shows
  int64_t rays = 0;
};

// All pixels that are not computed are the photograph's.
struct FinishedTile {
  int index = 0;
  TileCounts counts;
  std::vector<uint8_t> is_computed;  // 0 or 1 for each pixel, row by row
  std::vector<float> rgb;            // of the computed ones, in the same order
  // Of these, how much of each is of surfaces, mirrored or behind glass, that no photograph shows
  // [1/255].
  std::vector<uint8_t> unseen;
  std::string layers = {};  // what LayerImages has taken of it; "": nobody asked
};

}  // namespace insitu
