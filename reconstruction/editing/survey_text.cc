// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/survey_text.h"

namespace insitu {
namespace {

// How many bytes the character at `at` has; 0: it is not UTF-8.
size_t LengthOfCharacter(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  if (first < 0x80) return first == 0 ? 0 : 1;
  const size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + length > text.size()) return 0;
  for (size_t i = at + 1; i < at + length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const bool is_long =
      (first == 0xE0 && byte(at + 1) < 0xA0) || (first == 0xF0 && byte(at + 1) < 0x90);
  const bool is_outside = (first == 0xED && byte(at + 1) > 0x9F) ||  // surrogates
                          (first == 0xF4 && byte(at + 1) > 0x8F);
  return is_long || is_outside ? 0 : length;
}

}  // namespace

std::optional<size_t> FirstNotUtf8(const std::string& text) {
  for (size_t at = 0; at < text.size();) {
    const size_t length = LengthOfCharacter(text, at);
    if (length == 0) return at;
    at += length;
  }
  return std::nullopt;
}

}  // namespace insitu
