// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/csv_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "calibration/files/text_table.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

std::string Trimmed(const std::string& text) { return std::string(TrimmedView(text)); }

std::vector<std::string> SplitCells(const std::string& line) {
  std::vector<std::string> cells;
  size_t begin = 0;
  for (size_t comma; (comma = line.find(',', begin)) != std::string::npos; begin = comma + 1) {
    cells.push_back(Trimmed(line.substr(begin, comma - begin)));
  }
  cells.push_back(Trimmed(line.substr(begin)));
  return cells;
}

bool IsSkipped(const std::string& line) {
  const std::string text = Trimmed(line);
  return text.empty() || text[0] == '#';
}

std::string Joined(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ",") + word;
  return joined;
}

void CheckHeader(const std::filesystem::path& path, int line,
                 const std::vector<std::string>& header, const std::vector<std::string>& columns) {
  for (const char* separator : {";", "\t"}) {
    if (header.size() > 1 || header[0].find(separator) == std::string::npos) continue;
    throw InputError(path, line,
                     std::string("columns are separated by ") +
                         (*separator == ';' ? "semicolons" : "tabs") +
                         ", expected commas, and points in numbers: " + Joined(columns));
  }
  for (const std::string& column : columns) {
    const auto count = std::count(header.begin(), header.end(), column);
    if (count == 1) continue;
    throw InputError(path, line,
                     "column \"" + column + (count == 0 ? "\" is missing" : "\" stands twice") +
                         ", expected the header " + Joined(columns));
  }
}

CsvRow MakeRow(const std::filesystem::path& path, int line, const std::vector<std::string>& header,
               const std::vector<std::string>& cells) {
  if (cells.size() != header.size()) {
    throw InputError(path, line,
                     std::to_string(cells.size()) + " cells, expected " +
                         std::to_string(header.size()) + " (" + Joined(header) + ")");
  }
  CsvRow row{path, line, {}};
  for (size_t i = 0; i < header.size(); ++i) row.cells[header[i]] = cells[i];
  return row;
}

}  // namespace

const std::string& CsvRow::Text(const std::string& column) const {
  const auto cell = cells.find(column);
  if (cell == cells.end()) throw Error("column \"" + column + "\" is missing");
  if (cell->second.empty()) throw Error("column \"" + column + "\" is empty");
  return cell->second;
}

double CsvRow::Number(const std::string& column) const {
  const std::string& text = Text(column);
  const bool has_plus = text[0] == '+' && text[1] != '-';  // from_chars knows no plus sign
  const char* end = text.data() + text.size();
  double value = 0;
  const auto parsed = std::from_chars(text.data() + has_plus, end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) {
    throw Error("\"" + text + "\" in column \"" + column + "\", expected a finite number");
  }
  return value;
}

InputError CsvRow::Error(const std::string& message) const {
  return InputError(path, line, message);
}

std::vector<CsvRow> ReadCsv(const std::filesystem::path& path,
                            const std::vector<std::string>& columns) {
  std::string content = ReadWhole(path);
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);  // spreadsheets write this mark
  std::istringstream stream(content);
  std::vector<std::string> header;
  std::vector<CsvRow> rows;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (IsSkipped(text)) continue;
    const std::vector<std::string> cells = SplitCells(text);
    if (header.empty()) {
      CheckHeader(path, line, cells, columns);
      header = cells;
    } else {
      rows.push_back(MakeRow(path, line, header, cells));
    }
  }
  if (header.empty()) throw InputError(path, "empty, expected the header " + Joined(columns));
  return rows;
}

}  // namespace insitu
