// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/finished_tile.h"

#include <algorithm>

namespace insitu {
namespace {

int TilesAlong(int pixels) { return (pixels + kRenderTile - 1) / kRenderTile; }

}  // namespace

int TileCount(int width, int height) { return TilesAlong(width) * TilesAlong(height); }

Tile TileAt(int width, int height, int index) {
  const int columns = TilesAlong(width);
  const int left = index % columns * kRenderTile, top = index / columns * kRenderTile;
  return {left, top, std::min(left + kRenderTile, width), std::min(top + kRenderTile, height)};
}

}  // namespace insitu
