// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/wording.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace insitu {

std::string Formatted(const char* format, ...) {
  char text[256];
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const auto size = static_cast<size_t>(std::vsnprintf(text, sizeof text, format, arguments));
  va_end(arguments);
  std::string whole(text, std::min(size, sizeof text - 1));
  if (size >= sizeof text) {
    whole.resize(size);
    std::vsnprintf(whole.data(), size + 1, format, again);
  }
  va_end(again);
  return whole;
}

std::string Number(const char* format, double value) { return Formatted(format, value); }

std::string ShortNumber(double value) {
  if (std::abs(value) >= 100) return Number("%.0f", value);
  return Number(std::abs(value) < 1 ? "%.3g" : "%.2f", value);
}

std::string QuotedList(const std::vector<std::string>& names) {
  constexpr size_t kShown = 4;
  std::string list;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i == kShown && names.size() > kShown + 1) {
      return list + " and " + std::to_string(names.size() - kShown) + " others";
    }
    list += (i == 0 ? "'" : i + 1 == names.size() ? " and '" : ", '") + names[i] + "'";
  }
  return list;
}

std::string Listing(const std::string& what, const std::vector<std::string>& names, size_t shown) {
  std::string text = what + " (" + std::to_string(names.size()) + "): ";
  for (size_t i = 0; i < std::min(names.size(), shown); ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > shown) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

std::string Quoted(std::string_view text) {
  constexpr size_t kLongest = 40;
  std::string quoted = "\"";
  for (const char c : text.substr(0, kLongest)) quoted += (c >= ' ' && c <= '~') ? c : '?';
  return quoted + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace insitu
