// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/csv_file.h"

#include <algorithm>
#include <utility>

#include "calibration/files/delimited_rows.h"
#include "calibration/files/error_at.h"
#include "calibration/files/plain_text.h"
#include "calibration/files/words.h"

namespace insitu {
namespace {

std::string Joined(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ",") + word;
  return joined;
}

void CheckHeader(const std::filesystem::path& path, int line,
                 const std::vector<std::string>& header, const std::vector<std::string>& columns) {
  for (const std::string& column : columns) {
    const auto count = std::count(header.begin(), header.end(), column);
    if (count == 1) continue;
    const Sentence::Values values = {{"column", column}, {"header", Joined(columns)}};
    throw ErrorAt(
        {path, line},
        count == 0
            ? Sentence("columnMissing",
                       "column \"{column}\" is missing, expected the header {header}", values)
            : Sentence("columnTwice",
                       "column \"{column}\" stands twice, expected the header "
                       "{header}",
                       values));
  }
}

// Without the empty cells behind what the header names: spreadsheets write them.
std::vector<std::string> CheckedCells(const std::filesystem::path& path, DelimitedRow row,
                                      const std::vector<std::string>& header) {
  while (row.cells.size() > header.size() && row.cells.back().empty()) row.cells.pop_back();
  if (row.cells.size() == header.size()) return std::move(row.cells);
  throw ErrorAt(
      {path, row.line},
      Sentence("cellCount", "{count} cells, expected {expected}",
               {{"count", int(row.cells.size())},
                {"expected", std::to_string(header.size()) + " (" + Joined(header) + ")"}}));
}

// Of the first line that holds something and is no comment.
char SeparatorOf(std::string_view content) {
  const char stated = StatedSeparator(content);
  if (stated != '\0') return stated;
  while (!content.empty()) {
    const size_t end = std::min(content.find('\n'), content.size());
    const std::string_view line = TrimmedView(content.substr(0, end));
    if (!line.empty() && line[0] != '#') {
      const char separator = SeparatorOfLine(line);
      return separator == ' ' ? ',' : separator;
    }
    content.remove_prefix(std::min(end + 1, content.size()));
  }
  return ',';
}

// Between commas a number without quotes has none within it: nothing is to be learned.
NumberStyle StyleOf(const std::vector<DelimitedRow>& rows, std::string_view content,
                    char separator) {
  NumberStyle style;
  if (separator == ',' && content.find('"') == std::string_view::npos) return style;
  for (const DelimitedRow& row : rows) {
    for (const std::string& cell : row.cells) style.Learn(cell);
  }
  return style;
}

}  // namespace

const std::string* CsvRow::Find(const std::string& column) const {
  const auto title = std::find(columns->begin(), columns->end(), column);
  if (title == columns->end()) return nullptr;
  const std::string& cell = cells[static_cast<size_t>(title - columns->begin())];
  return cell.empty() ? nullptr : &cell;
}

const std::string& CsvRow::Text(const std::string& column) const {
  if (const std::string* cell = Find(column)) return *cell;
  const bool is_there = std::ranges::find(*columns, column) != columns->end();
  throw ErrorAt(
      {path, line},
      is_there ? Sentence("cellEmpty", "column \"{column}\" is empty", {{"column", column}})
               : Sentence("columnNone", "column \"{column}\" is missing", {{"column", column}}));
}

double CsvRow::Number(const std::string& column) const {
  const std::string& text = Text(column);
  const auto value = style.Parse(text);
  if (value) return *value;
  const Sentence::Values values = {{"text", text}, {"column", column}};
  throw ErrorAt(
      {path, line},
      style.is_mixed()
          ? Sentence("cellMixed",
                     "\"{text}\" in column \"{column}\", expected a finite number; some "
                     "numbers of the table have decimal commas, others points",
                     values)
          : Sentence("cellNumber", "\"{text}\" in column \"{column}\", expected a finite number",
                     values));
}

InputError CsvRow::Error(const std::string& message) const {
  return InputError(path, line, message);
}

std::vector<CsvRow> ReadCsv(const std::filesystem::path& path,
                            const std::vector<std::string>& columns) {
  const std::string content = ReadPlainText(path);
  const char separator = SeparatorOf(content);
  std::vector<DelimitedRow> lines = SplitDelimited(path, content, separator);
  if (lines.empty()) {
    throw ErrorAt({path}, Sentence("tableEmpty", "empty, expected the header {header}",
                                   {{"header", Joined(columns)}}));
  }
  CheckHeader(path, lines[0].line, lines[0].cells, columns);
  const auto header = std::make_shared<const std::vector<std::string>>(std::move(lines[0].cells));
  lines.erase(lines.begin());
  const NumberStyle style = StyleOf(lines, content, separator);
  std::vector<CsvRow> rows;
  rows.reserve(lines.size());
  for (DelimitedRow& line : lines) {
    const int number = line.line;
    rows.push_back({path, number, CheckedCells(path, std::move(line), *header), header, style});
  }
  return rows;
}

}  // namespace insitu
