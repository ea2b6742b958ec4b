// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/cryptomatte.h"

#include <json/value.h>
#include <json/writer.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

uint32_t Mixed(uint32_t block) {
  block *= 0xcc9e2d51U;
  return std::rotl(block, 15) * 0x1b873593U;
}

uint32_t Finished(uint32_t hash) {
  hash ^= hash >> 16;
  hash *= 0x85ebca6bU;
  hash ^= hash >> 13;
  hash *= 0xc2b2ae35U;
  return hash ^ hash >> 16;
}

std::string HexText(float id) { return Formatted("%08x", std::bit_cast<uint32_t>(id)); }

}  // namespace

uint32_t MurmurHash3(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<uint32_t>(static_cast<uint8_t>(text[i])); };
  uint32_t hash = 0;
  size_t at = 0;
  for (; at + 4 <= text.size(); at += 4) {
    hash ^= Mixed(byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 | byte(at + 3) << 24);
    hash = std::rotl(hash, 13) * 5 + 0xe6546b64U;
  }
  uint32_t tail = 0;
  for (size_t i = text.size(); i > at; --i) tail = tail << 8 | byte(i - 1);
  if (at < text.size()) hash ^= Mixed(tail);
  return Finished(hash ^ static_cast<uint32_t>(text.size()));
}

float CryptomatteId(std::string_view name) {
  uint32_t hash = MurmurHash3(name);
  const uint32_t exponent = hash >> 23 & 255;
  if (exponent == 0 || exponent == 255) hash ^= 1U << 23;
  return std::bit_cast<float>(hash);
}

std::vector<float> CryptomatteRanks(const std::map<int, double>& shares,
                                    const std::vector<float>& ids) {
  std::vector<std::pair<double, int>> sorted;
  for (const auto& [index, share] : shares) sorted.emplace_back(-share, index);
  std::sort(sorted.begin(), sorted.end());
  std::vector<float> ranks(2 * static_cast<size_t>(kCryptomatteRanks));
  for (size_t i = 0; i < std::min<size_t>(kCryptomatteRanks, sorted.size()); ++i) {
    ranks[2 * i] = ids.at(static_cast<size_t>(sorted[i].second));
    ranks[2 * i + 1] = static_cast<float>(-sorted[i].first);
  }
  return ranks;
}

std::string CryptomatteManifest(const std::vector<std::string>& names) {
  Json::Value manifest(Json::objectValue);
  for (const std::string& name : names) manifest[name] = HexText(CryptomatteId(name));
  Json::StreamWriterBuilder one_line;
  one_line["indentation"] = "";
  return Json::writeString(one_line, manifest);
}

std::string CryptomatteKey(std::string_view matte) {
  return Formatted("%08x", MurmurHash3(matte)).substr(0, 7);
}

}  // namespace insitu
