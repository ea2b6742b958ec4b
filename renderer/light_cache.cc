// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/light_cache.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

static_assert(std::endian::native == std::endian::little);  // as the file is

constexpr char kWord[] = "insitu-light-1";

// Numbers one after the other, as memory has them.
class LightBytes {
 public:
  template <typename Number>
  void operator()(const Number& number) requires std::is_arithmetic_v<Number> {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  template <typename Number, int rows>
  void operator()(const Eigen::Array<Number, rows, 1>& numbers) {
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), sizeof(Number) * rows);
  }
  template <typename Number, int rows>
  void operator()(const Eigen::Matrix<Number, rows, 1>& numbers) {
    (*this)(Eigen::Array<Number, rows, 1>(numbers.array()));
  }
  template <typename Item, typename Each>
  void List(const std::vector<Item>& items, const Each& each) {
    (*this)(static_cast<uint64_t>(items.size()));
    for (const Item& item : items) each(*this, item);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// The same read again. What is missing is zero, and told.
class LightNumbers {
 public:
  explicit LightNumbers(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number>
  void operator()(Number& number) requires std::is_arithmetic_v<Number> {
    Take(&number, sizeof number);
  }
  template <typename Number, int rows>
  void operator()(Eigen::Array<Number, rows, 1>& numbers) {
    Take(numbers.data(), sizeof(Number) * rows);
  }
  template <typename Number, int rows>
  void operator()(Eigen::Matrix<Number, rows, 1>& numbers) {
    Take(numbers.data(), sizeof(Number) * rows);
  }
  template <typename Item, typename Each>
  void List(std::vector<Item>& items, const Each& each) {
    uint64_t count = 0;
    (*this)(count);
    items.reserve(std::min<uint64_t>(count, bytes_.size() / sizeof(Item)));
    // Every item takes bytes, so that a wrong count ends at the end of the file.
    for (uint64_t i = 0; i < count && is_whole_; ++i) each(*this, items.emplace_back());
  }

  bool IsReadUp() const { return is_whole_ && bytes_.empty(); }

 private:
  void Take(void* to, size_t size) {
    if (bytes_.size() < size) {
      is_whole_ = false;
      return;
    }
    std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
  bool is_whole_ = true;
};

// The order in the file: `file` is LightBytes or LightNumbers, `light` const with the first.
template <typename File, typename Light>
void PassLight(File& file, Light& light) {
  const auto each_point = [](File& to, auto& point) {
    for (auto& cell : point.cells) to(cell);
    to(point.before);
    to(point.change);
    to(point.calm);
    to(point.is_open);
  };
  const auto each_piece = [](File& to, auto& piece) {
    to(piece.point.position);
    to(piece.point.normal);
    to(piece.polygon);
    to(piece.is_beyond);
    to(piece.is_seen);
    to(piece.before);
    to(piece.change);
    to(piece.irradiance);
  };
  file(light.solved.sky);
  file(light.solved.beyond);
  file.List(light.solved.brdf_of_polygon, [](File& to, auto& brdf) { to(brdf); });
  file.List(light.solved.pieces, each_piece);
  file.List(light.on_site, each_point);
  file.List(light.on_building, each_point);
}

std::string FirstLine(const std::string& inputs, const std::string& content) {
  return std::string(kWord) + " " + inputs + " " + content + "\n";
}

}  // namespace

std::optional<KeptLight> ReadLightCache(const std::filesystem::path& path,
                                        const std::string& inputs) {
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  const std::string text = ReadWhole(path);
  const size_t end = text.find('\n');
  if (end == std::string::npos) return std::nullopt;
  const std::string_view content = std::string_view(text).substr(end + 1);
  if (text.rfind(std::string(kWord) + " " + inputs + " ", 0) != 0) return std::nullopt;
  if (text.substr(0, end + 1) != FirstLine(inputs, Sha256OfText(content))) return std::nullopt;
  KeptLight light;
  LightNumbers numbers(content);
  PassLight(numbers, light);
  if (!numbers.IsReadUp()) return std::nullopt;
  return light;
}

void WriteLightCache(const std::filesystem::path& path, const std::string& inputs,
                     const KeptLight& light) {
  if (light.on_site.size() + light.on_building.size() > kMostKeptPoints) {
    std::filesystem::remove(path);
    return;
  }
  LightBytes bytes;
  PassLight(bytes, light);
  WriteWhole(path, FirstLine(inputs, Sha256OfText(bytes.bytes())) + bytes.bytes());
}

}  // namespace insitu
