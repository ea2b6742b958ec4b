// SPDX-License-Identifier: GPL-3.0-or-later
// Names of layers and blocks, from the drawing's code page to UTF-8.
#include <charconv>
#include <cstdint>

#include "renderer/dxf_record.h"

namespace insitu {
namespace {

void AppendUtf8(uint32_t code_point, std::string* text) {
  const auto append = [text](uint32_t byte) { text->push_back(static_cast<char>(byte)); };
  if (code_point < 0x80) {
    append(code_point);
  } else if (code_point < 0x800) {
    append(0xC0 | code_point >> 6);
    append(0x80 | (code_point & 0x3F));
  } else {
    append(0xE0 | code_point >> 12);
    append(0x80 | (code_point >> 6 & 0x3F));
    append(0x80 | (code_point & 0x3F));
  }
}

// Length of the UTF-8 character at the front of `text`; 0 if there is none.
size_t Utf8Length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const size_t length = lead < 0x80                    ? 1
                        : lead >= 0xC2 && lead <= 0xDF ? 2
                        : lead >= 0xE0 && lead <= 0xEF ? 3
                        : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                       : 0;
  if (length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

bool IsUtf8(std::string_view text) {
  while (!text.empty()) {
    const size_t length = Utf8Length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

// Windows-1252 differs from Latin-1 in 0x80..0x9F (zero: unassigned there).
// Source: www.unicode.org/Public/MAPPINGS/VENDORS/MICSFT/WINDOWS/CP1252.TXT
constexpr uint16_t kWindows1252[32] = {
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017D, 0,      0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

std::string FromWindows1252(std::string_view text) {
  std::string utf8;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool special = byte >= 0x80 && byte < 0xA0;
    AppendUtf8(special && kWindows1252[byte - 0x80] ? kWindows1252[byte - 0x80] : byte, &utf8);
  }
  return utf8;
}

// The character of "\U+XXXX" at the front of `text`.
std::optional<uint32_t> EscapedCharacter(std::string_view text) {
  if (text.size() < 7 || !text.starts_with("\\U+")) return std::nullopt;
  uint32_t code_point = 0;
  const char* const end = text.data() + 7;
  const auto result = std::from_chars(text.data() + 3, end, code_point, 16);
  const bool surrogate = code_point >= 0xD800 && code_point < 0xE000;
  if (result.ec != std::errc() || result.ptr != end || surrogate) return std::nullopt;
  return code_point;
}

}  // namespace

std::string Utf8FromDxf(std::string_view text) {
  const std::string encoded = IsUtf8(text) ? std::string(text) : FromWindows1252(text);
  std::string name;
  for (size_t i = 0; i < encoded.size();) {
    const auto character = EscapedCharacter(std::string_view(encoded).substr(i));
    if (character) {
      AppendUtf8(*character, &name);
    } else {
      name.push_back(encoded[i]);
    }
    i += character ? 7 : 1;
  }
  return name;
}

}  // namespace insitu
