// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/text_lines.h"

#include <cstdint>
#include <fstream>
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

}  // namespace

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
  if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF")) {
    const std::string whole = ReadWhole(path);
    head = Utf8FromUtf16(std::string_view(whole).substr(2), whole.front() == '\xFF');
    stream_ = std::make_unique<std::istringstream>(head);
  }
  if (head.find('\n') == head.npos && head.find('\r') != head.npos) end_ = '\r';
}

bool TextLines::Next(std::string* line) {
  if (!std::getline(*stream_, *line, end_)) return false;
  if (line->ends_with('\r')) line->pop_back();
  return true;
}

}  // namespace insitu
