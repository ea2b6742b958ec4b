// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/png_eighth.h"

#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "calibration/tiles/eighth_sums.h"

namespace insitu {
namespace {

constexpr int kRowsAtOnce = 64;
constexpr size_t kMostChunk = size_t{1} << 28;  // bytes of an IDAT chunk that are believed

uint32_t BigEndian(const uint8_t* bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

// [PNG, 11.2.2]
struct PngHeader {
  int width = 0, height = 0, channels = 0, depth = 0;

  size_t pixel_bytes() const { return static_cast<size_t>(channels) * depth / 8; }
  size_t row_bytes() const { return pixel_bytes() * width; }
};

// Its chunks, one after the other.
class PngChunks {
 public:
  explicit PngChunks(const std::filesystem::path& path) : buffer_(1 << 18) {
    file_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    file_.open(path, std::ios::binary);
  }

  // nullopt: not one that is read here.
  std::optional<PngHeader> Header() {
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    std::array<uint8_t, 33> start;  // the signature and the chunk IHDR
    if (!Read(start) || std::memcmp(start.data(), kSignature.data(), kSignature.size()) != 0) {
      return std::nullopt;
    }
    constexpr std::array<int, 7> kChannels = {1, 0, 3, 0, 2, 0, 4};  // by colour type
    const uint8_t* header = start.data() + 16;
    const uint32_t width = BigEndian(header), height = BigEndian(header + 4);
    const int depth = header[8], type = header[9], interlaced = header[12];
    constexpr uint32_t kMostSide = 1 << 20;
    const bool is_plain = (depth == 8 || depth == 16) && type < 7 && kChannels.at(type) > 0 &&
                          interlaced == 0 && width - 1 < kMostSide && height - 1 < kMostSide;
    if (!is_plain) return std::nullopt;
    return PngHeader{static_cast<int>(width), static_cast<int>(height), kChannels.at(type), depth};
  }

  // What the next IDAT holds; empty at the end.
  std::span<uint8_t> NextData() {
    std::array<uint8_t, 8> head;
    while (Read(head)) {
      const size_t size = BigEndian(head.data());
      if (std::memcmp(&head[4], "IDAT", 4) != 0) {
        file_.ignore(static_cast<std::streamsize>(size) + kCheckSum);
        continue;
      }
      if (size > kMostChunk) return {};
      data_.resize(size);
      if (!Read(data_)) return {};
      file_.ignore(kCheckSum);  // zlib has its own
      if (size > 0) return data_;
    }
    return {};
  }

 private:
  static constexpr int kCheckSum = 4;

  bool Read(std::span<uint8_t> to) {
    file_.read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size()));
    return file_.gcount() == static_cast<std::streamsize>(to.size());
  }

  std::vector<char> buffer_;  // outlives the file
  std::ifstream file_;
  std::vector<uint8_t> data_;
};

// The bytes of the rows, filtered.
class PngStream {
 public:
  explicit PngStream(PngChunks* chunks) : chunks_(chunks), state_(new inflate_state) {
    isal_inflate_init(state_.get());
    state_->crc_flag = ISAL_ZLIB;
  }

  // False: cut short or damaged.
  bool Read(std::span<uint8_t> to) {
    state_->next_out = to.data();
    state_->avail_out = static_cast<uint32_t>(to.size());
    while (state_->avail_out > 0) {
      if (state_->block_state == ISAL_BLOCK_FINISH || !Step()) return false;
    }
    return true;
  }

  // Whether nothing follows and the check sum is right.
  bool IsAtEnd() {
    uint8_t more = 0;
    state_->next_out = &more;
    state_->avail_out = 1;
    while (state_->block_state != ISAL_BLOCK_FINISH) {
      if (!Step()) return false;
    }
    return state_->avail_out == 1;
  }

 private:
  // Bits and bytes that wait within the state come out before more are asked for.
  bool Step() {
    const uint32_t room = state_->avail_out;
    if (is_begun_ && isal_inflate(state_.get()) < 0) return false;
    const bool is_on = state_->avail_in > 0 || state_->avail_out < room ||
                       state_->block_state == ISAL_BLOCK_FINISH;
    if (is_begun_ && is_on) return true;
    is_begun_ = true;
    const std::span<uint8_t> data = chunks_->NextData();
    state_->next_in = data.data();
    state_->avail_in = static_cast<uint32_t>(data.size());
    return !data.empty();
  }

  PngChunks* chunks_;
  std::unique_ptr<inflate_state> state_;  // 84 kB
  bool is_begun_ = false;
};

uint8_t Paeth(int a, int b, int c) {
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  return static_cast<uint8_t>(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
}

// A row after its filter's byte, in place; `above`: the row before. [PNG, 9.2]
bool Unfilter(int filter, std::span<uint8_t> row, const uint8_t* above, size_t step) {
  uint8_t* x = row.data();
  const size_t size = row.size();
  const auto add = [](uint8_t* to, int value) { *to = static_cast<uint8_t>(*to + value); };
  switch (filter) {
    case 0:
      return true;
    case 1:
      for (size_t i = step; i < size; ++i) add(x + i, x[i - step]);
      return true;
    case 2:
      for (size_t i = 0; i < size; ++i) add(x + i, above[i]);
      return true;
    case 3:
      for (size_t i = 0; i < step; ++i) add(x + i, above[i] / 2);
      for (size_t i = step; i < size; ++i) add(x + i, (x[i - step] + above[i]) / 2);
      return true;
    case 4:
      for (size_t i = 0; i < step; ++i) add(x + i, above[i]);
      for (size_t i = step; i < size; ++i) {
        add(x + i, Paeth(x[i - step], above[i], above[i - step]));
      }
      return true;
    default:
      return false;
  }
}

// Takes filtered rows and sums what they mean.
class PngRowSums {
 public:
  explicit PngRowSums(const PngHeader& header)
      : header_(header),
        sums_(header.width, header.height),
        above_(header.row_bytes()),
        wide_(header.depth == 16 ? header.row_bytes() / 2 : 0) {}

  bool Take(int first, std::span<uint8_t> rows) {
    const size_t size = header_.row_bytes() + 1;
    for (int y = first; !rows.empty(); ++y, rows = rows.subspan(size)) {
      const std::span<uint8_t> row = rows.subspan(1, size - 1);
      if (!Unfilter(rows[0], row, above_.data(), header_.pixel_bytes())) return false;
      std::memcpy(above_.data(), row.data(), row.size());
      Sum(y, row);
    }
    return true;
  }

  cv::Mat Means() const { return sums_.Means(header_.depth == 16 ? CV_16U : CV_8U); }

 private:
  void Sum(int y, std::span<const uint8_t> row) {
    if (header_.depth == 8) return sums_.Add(y, row.data(), header_.channels);
    for (size_t i = 0; i < wide_.size(); ++i) {
      wide_[i] = static_cast<uint16_t>(row[2 * i] << 8 | row[2 * i + 1]);
    }
    sums_.Add(y, wide_.data(), header_.channels);
  }

  const PngHeader header_;
  EighthSums sums_;
  std::vector<uint8_t> above_;
  std::vector<uint16_t> wide_;
};

}  // namespace

cv::Mat ReadEighthOfPng(const std::filesystem::path& path) {
  PngChunks chunks(path);
  const auto header = chunks.Header();
  if (!header) return {};
  PngStream stream(&chunks);
  PngRowSums sums(*header);
  const size_t row_size = header->row_bytes() + 1;
  std::vector<uint8_t> inflated(kRowsAtOnce * row_size), taken(inflated.size());
  std::future<bool> is_taken;
  for (int y = 0; y < header->height; y += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, header->height - y);
    const std::span<uint8_t> rows(inflated.data(), count * row_size);
    if (!stream.Read(rows)) return {};
    if (is_taken.valid() && !is_taken.get()) return {};
    std::swap(inflated, taken);
    is_taken = std::async(std::launch::async, [&sums, y, rows] { return sums.Take(y, rows); });
  }
  if (!is_taken.get() || !stream.IsAtEnd()) return {};
  return sums.Means();
}

}  // namespace insitu
