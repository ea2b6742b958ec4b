// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/text_lines.h"

#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

void AppendUtf8(uint32_t code, std::string* text) {
  const auto tail = [&](int shift) {
    text->push_back(static_cast<char>(0x80 | ((code >> shift) & 0x3F)));
  };
  if (code < 0x80) {
    text->push_back(static_cast<char>(code));
  } else if (code < 0x800) {
    text->push_back(static_cast<char>(0xC0 | (code >> 6)));
    tail(0);
  } else if (code < 0x10000) {
    text->push_back(static_cast<char>(0xE0 | (code >> 12)));
    tail(6);
    tail(0);
  } else {
    text->push_back(static_cast<char>(0xF0 | (code >> 18)));
    tail(12);
    tail(6);
    tail(0);
  }
}

// Its mark, or letters with zeros between; then the mark's length.
struct Utf16 {
  bool little;
  size_t mark;
};

std::optional<Utf16> Utf16Of(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE\xFF\x0E")) return std::nullopt;  // SketchUp's
  if (bytes.starts_with("\xFF\xFE")) return Utf16{true, 2};
  if (bytes.starts_with("\xFE\xFF")) return Utf16{false, 2};
  constexpr size_t kGuessed = 16;
  if (bytes.size() < kGuessed) return std::nullopt;
  int letters[2] = {0, 0}, zeros[2] = {0, 0};
  for (size_t i = 0; i < kGuessed; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    zeros[i % 2] += byte == 0;
    letters[i % 2] += byte == '\t' || byte == '\n' || byte == '\r' || (byte >= ' ' && byte < 127);
  }
  constexpr int kHalf = kGuessed / 2;
  if (letters[0] == kHalf && zeros[1] == kHalf) return Utf16{true, 0};
  if (letters[1] == kHalf && zeros[0] == kHalf) return Utf16{false, 0};
  return std::nullopt;
}

}  // namespace

bool IsUtf16(std::string_view bytes) { return Utf16Of(bytes).has_value(); }

std::string Utf8FromUtf16(std::string_view bytes, bool little_endian) {
  const auto unit = [&](size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]);
    const auto b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<uint32_t>(little_endian ? a | b << 8 : a << 8 | b);
  };
  std::string text;
  for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
    uint32_t code = unit(i);
    if (code >= 0xD800 && code < 0xE000) {
      const uint32_t low = code < 0xDC00 && i + 3 < bytes.size() ? unit(i + 2) : 0;
      const bool pair = low >= 0xDC00 && low < 0xE000;
      code = pair ? 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00) : 0xFFFD;
      if (pair) i += 2;
    }
    AppendUtf8(code, &text);
  }
  return text;
}

std::string DecodedText(std::string bytes) {
  if (const auto utf16 = Utf16Of(bytes)) {
    return Utf8FromUtf16(std::string_view(bytes).substr(utf16->mark), utf16->little);
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  return bytes;
}

TextLines::TextLines(const std::filesystem::path& path) {
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file) throw InputError(path, "cannot be read");
  constexpr size_t kHead = 1 << 16;
  std::string head(kHead, '\0');
  file->read(head.data(), kHead);
  head.resize(static_cast<size_t>(file->gcount()));
  file->clear();
  file->seekg(head.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  stream_ = std::move(file);
  if (IsUtf16(head)) {
    head = DecodedText(ReadWhole(path));
    stream_ = std::make_unique<std::istringstream>(head);
  }
  if (head.find('\n') == head.npos && head.find('\r') != head.npos) end_ = '\r';
}

bool TextLines::Next(std::string* line) {
  if (!std::getline(*stream_, *line, end_)) return false;
  // Zeros, and the mark of old systems, fill the end of some files.
  const auto is_end = [](char c) { return c == '\r' || c == '\0' || c == '\x1A'; };
  while (!line->empty() && is_end(line->back())) line->pop_back();
  return true;
}

}  // namespace insitu
