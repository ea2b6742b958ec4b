// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/wording.h"

#include <algorithm>
#include <cstdio>

namespace insitu {

std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
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
