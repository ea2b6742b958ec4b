// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/tile_record.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <vector>

namespace insitu {
namespace {

static_assert(std::endian::native == std::endian::little);  // as the file is

constexpr char kFirstWord[] = "insitu-partial-3";
constexpr size_t kFrameBytes = 2 * sizeof(uint32_t);  // length before, check sum after

using CountMember = int64_t TileCounts::*;
constexpr CountMember kCounts[] = {&TileCounts::building,         &TileCounts::changed,
                                   &TileCounts::clipped_darkened, &TileCounts::clipped_lifted,
                                   &TileCounts::unseen,           &TileCounts::rays};
constexpr size_t kFixedBytes = sizeof(int32_t) + std::size(kCounts) * sizeof(int64_t);

template <typename Value>
void Append(std::string* bytes, const Value& value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
Value Take(std::string_view* bytes) {
  Value value;
  std::memcpy(&value, bytes->data(), sizeof value);
  bytes->remove_prefix(sizeof value);
  return value;
}

uint32_t CheckSum(std::string_view bytes) {
  return static_cast<uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::vector<std::string_view> WordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const size_t end = std::min(line.find(' '), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return words;
}

bool ReadPositive(std::string_view word, int* value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), *value);
  return error == std::errc() && end == word.data() + word.size() && *value > 0;
}

// Of a content whose check sum is right and that is long enough for what has a fixed length.
std::optional<FinishedTile> ReadContent(std::string_view content, const PartialHeader& header) {
  FinishedTile tile;
  tile.index = Take<int32_t>(&content);
  for (const CountMember count : kCounts) tile.counts.*count = Take<int64_t>(&content);
  if (tile.index < 0 || tile.index >= TileCount(header.width, header.height)) return std::nullopt;
  const int pixels = TileAt(header.width, header.height, tile.index).pixels();
  const size_t mask_bytes = (static_cast<size_t>(pixels) + 7) / 8;
  if (content.size() < mask_bytes) return std::nullopt;
  size_t computed = 0;
  for (int i = 0; i < pixels; ++i) {
    tile.is_computed.push_back(static_cast<uint8_t>(content[i / 8]) >> (i % 8) & 1);
    computed += tile.is_computed.back();
  }
  content.remove_prefix(mask_bytes);
  const size_t rgb_bytes = computed * 3 * sizeof(float);
  if (content.size() < rgb_bytes + computed) return std::nullopt;
  tile.layers = content.substr(rgb_bytes + computed);
  tile.rgb.resize(3 * computed);
  tile.unseen.resize(computed);
  if (computed == 0) return tile;
  std::memcpy(tile.rgb.data(), content.data(), rgb_bytes);
  std::memcpy(tile.unseen.data(), content.data() + rgb_bytes, computed);
  return tile;
}

}  // namespace

std::string HeaderText(const PartialHeader& header) {
  return std::string(kFirstWord) + " " + std::to_string(header.width) + " " +
         std::to_string(header.height) + " " + header.frame + " " + header.inputs + "\n";
}

std::optional<PartialHeader> ReadHeader(std::string_view text, size_t* bytes) {
  const size_t end = text.substr(0, kMostHeaderBytes).find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const std::vector<std::string_view> words = WordsOf(text.substr(0, end));
  PartialHeader header;
  if (words.size() != 5 || words[0] != kFirstWord) return std::nullopt;
  if (!ReadPositive(words[1], &header.width)) return std::nullopt;
  if (!ReadPositive(words[2], &header.height)) return std::nullopt;
  header.frame = words[3];
  header.inputs = words[4];
  *bytes = end + 1;
  return header;
}

std::string TileRecord(const FinishedTile& tile) {
  std::string content;
  Append(&content, static_cast<int32_t>(tile.index));
  for (const CountMember count : kCounts) Append(&content, tile.counts.*count);
  std::string mask((tile.is_computed.size() + 7) / 8, '\0');
  for (size_t i = 0; i < tile.is_computed.size(); ++i) {
    mask[i / 8] = static_cast<char>(mask[i / 8] | tile.is_computed[i] << (i % 8));
  }
  content += mask;
  content.append(reinterpret_cast<const char*>(tile.rgb.data()), tile.rgb.size() * sizeof(float));
  content.append(tile.unseen.begin(), tile.unseen.end());
  content += tile.layers;
  std::string record;
  Append(&record, static_cast<uint32_t>(content.size()));
  record += content;
  Append(&record, CheckSum(content));
  return record;
}

std::optional<FinishedTile> ReadTileRecord(std::string_view bytes, const PartialHeader& header,
                                           size_t* length) {
  if (bytes.size() < kFrameBytes + kFixedBytes) return std::nullopt;
  const auto size = size_t{Take<uint32_t>(&bytes)};
  if (size < kFixedBytes || bytes.size() < size + sizeof(uint32_t)) return std::nullopt;
  const std::string_view content = bytes.substr(0, size);
  bytes.remove_prefix(size);
  if (Take<uint32_t>(&bytes) != CheckSum(content)) return std::nullopt;
  *length = kFrameBytes + size;
  return ReadContent(content, header);
}

}  // namespace insitu
