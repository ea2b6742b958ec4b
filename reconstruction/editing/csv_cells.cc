// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/csv_cells.h"

#include "calibration/files/text_table.h"

namespace insitu {

std::vector<std::string_view> RawCells(std::string_view text) {
  std::vector<std::string_view> cells;
  size_t begin = 0;
  bool is_quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool is_opening = text[i] == '"' && TrimmedView(text.substr(begin, i - begin)).empty();
    if (text[i] == '"' && (is_quoted || is_opening)) is_quoted = !is_quoted;
    if (text[i] != ',' || is_quoted) continue;
    cells.push_back(text.substr(begin, i - begin));
    begin = i + 1;
  }
  cells.push_back(text.substr(begin));
  return cells;
}

std::string CellOf(std::string_view raw) {
  const std::string_view trimmed = TrimmedView(raw);
  if (trimmed.size() < 2 || trimmed.front() != '"' || trimmed.back() != '"')
    return std::string(trimmed);
  std::string text;
  for (size_t i = 1; i + 1 < trimmed.size(); ++i) {
    text += trimmed[i];
    if (trimmed[i] == '"' && i + 2 < trimmed.size() && trimmed[i + 1] == '"') ++i;
  }
  return text;
}

std::string InPlaceOf(std::string_view old, const std::string& text) {
  const std::string_view trimmed = TrimmedView(old);
  if (trimmed.empty()) return text;
  const size_t begin = static_cast<size_t>(trimmed.data() - old.data());
  return std::string(old.substr(0, begin)) + text + std::string(old.substr(begin + trimmed.size()));
}

}  // namespace insitu
