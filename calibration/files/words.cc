// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/words.h"

#include <charconv>
#include <cmath>

namespace insitu {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

}  // namespace

std::optional<double> ParseNumber(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::string Digits(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string_view TrimmedView(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> SplitAt(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  text = TrimmedView(text);
  if (text.empty()) return pieces;
  for (size_t end; (end = text.find(separator)) != std::string_view::npos;) {
    pieces.emplace_back(TrimmedView(text.substr(0, end)));
    text.remove_prefix(end + 1);
  }
  pieces.emplace_back(TrimmedView(text));
  return pieces;
}

std::vector<std::string> SplitAtBlanks(std::string_view text) {
  std::vector<std::string> pieces;
  for (text = TrimmedView(text); !text.empty(); text = TrimmedView(text)) {
    const bool is_quoted = text[0] == '"' && text.find('"', 1) != std::string_view::npos;
    const size_t end = is_quoted ? text.find('"', 1) : text.find_first_of(kBlanks);
    pieces.emplace_back(is_quoted ? text.substr(1, end - 1) : text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return pieces;
}

}  // namespace insitu
