// SPDX-License-Identifier: GPL-3.0-or-later
// Finished tiles as bytes of a file: what a killed program or a full disk cut short is known as
// such.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "renderer/tiles/finished_tile.h"

namespace insitu {

// A picture of which tiles are rendered, and what it is made of.
struct PartialHeader {
  int width = 0, height = 0;  // [px]
  std::string frame;          // "photo" or "pinhole"
  std::string inputs;         // hash of all that its pixels depend on
  bool operator==(const PartialHeader&) const = default;
};

inline constexpr size_t kMostHeaderBytes = 200;

// A line, its end included.
std::string HeaderText(const PartialHeader& header);

// nullopt: `text` does not begin with a whole header. `bytes` receives how long it is.
std::optional<PartialHeader> ReadHeader(std::string_view text, size_t* bytes);

// Length, content, check sum.
std::string TileRecord(const FinishedTile& tile);

// The tile that `bytes` begin with. nullopt: it is not all there, not as it was written, or none of
// this picture. `length` receives the bytes it takes.
std::optional<FinishedTile> ReadTileRecord(std::string_view bytes, const PartialHeader& header,
                                           size_t* length);

}  // namespace insitu
