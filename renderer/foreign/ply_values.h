// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a PLY file's body, one after the other, in text or binary.
#pragma once

#include <bit>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
#include "calibration/files/wording.h"
#include "renderer/foreign/ply_head.h"

namespace insitu {

class PlyValues {
 public:
  PlyValues(const std::filesystem::path& path, const PlyHead& head, std::string_view bytes)
      : path_(path),
        head_(head),
        rest_(bytes.substr(head.size)),
        size_(bytes.size()),
        line_(head.lines + 1) {}

  // Throws InputError: the file ends, with the element that it ends in; no number.
  double Next(PlyType type) {
    return head_.encoding == PlyEncoding::kText ? NextWord() : NextBytes(type);
  }

  // Of which element values are taken, for messages.
  void Begin(const PlyElement& element, int64_t index) {
    element_ = &element;
    index_ = index;
  }
  bool HasMore() const { return rest_.find_first_not_of(" \t\r\n") != rest_.npos; }

 private:
  double NextWord() {
    size_t first = 0;
    while (first < rest_.size() && static_cast<unsigned char>(rest_[first]) <= ' ') {
      line_ += rest_[first] == '\n';
      ++first;
    }
    size_t end = first;
    while (end < rest_.size() && static_cast<unsigned char>(rest_[end]) > ' ') ++end;
    if (first == end) throw Ended();
    std::string_view word = rest_.substr(first, end - first);
    rest_.remove_prefix(end);
    if (word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const auto [stop, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status == std::errc() && stop == word.data() + word.size()) return value;
    if (IsNoNumber(word)) return std::numeric_limits<double>::quiet_NaN();
    throw InputError(path_, line_, Quoted(word) + ", expected a number");
  }

  double NextBytes(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return Take<int8_t>();
      case PlyType::kUint8:
        return Take<uint8_t>();
      case PlyType::kInt16:
        return Take<int16_t>();
      case PlyType::kUint16:
        return Take<uint16_t>();
      case PlyType::kInt32:
        return Take<int32_t>();
      case PlyType::kUint32:
        return Take<uint32_t>();
      case PlyType::kFloat:
        return Take<float>();
      case PlyType::kDouble:
        return Take<double>();
    }
    return 0;
  }

  template <typename T>
  double Take() {
    if (rest_.size() < sizeof(T)) throw Ended();
    char bytes[sizeof(T)];
    std::memcpy(bytes, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    if (head_.encoding == PlyEncoding::kBigEndian) {
      for (size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    }
    T value{};
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
  }

  InputError Ended() const {
    return {path_, "is " + std::to_string(size_) + " bytes long and ends in " + element_->name +
                       " " + std::to_string(index_ + 1) + " of the " +
                       std::to_string(element_->count) + " that line " +
                       std::to_string(element_->line) + " states: it is cut short"};
  }

  const std::filesystem::path& path_;
  const PlyHead& head_;
  std::string_view rest_;
  size_t size_;
  int line_;
  const PlyElement* element_ = nullptr;
  int64_t index_ = 0;
};

}  // namespace insitu
