// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/text_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "calibration/files/delimited_rows.h"
#include "calibration/files/error_at.h"
#include "calibration/files/number_style.h"
#include "calibration/files/plain_text.h"

namespace insitu {
namespace {

// Numbers with decimal commas or marks between thousands as ParseNumber wants them.
void MakePlain(const NumberStyle& style, std::vector<std::string>* words) {
  for (std::string& word : *words) {
    const auto number = style.Parse(word), as_it_stands = ParseNumber(word);
    if (number && number != as_it_stands) word = Digits(*number);
  }
}

// Whether tabulators stand among blanks only to line columns up.
bool AreAligned(const std::vector<std::string>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](const std::string& cell) {
    const std::vector<std::string> words = SplitAtBlanks(cell);
    return words.size() > 1 && std::all_of(words.begin(), words.end(), [](const auto& word) {
             return ParseNumber(word).has_value();
           });
  });
}

std::vector<TextRow> SplitRowsAt(const std::filesystem::path& path, const std::string& content,
                                 char separator) {
  std::vector<TextRow> rows;
  for (DelimitedRow& row : SplitDelimited(path, content, separator)) {
    rows.push_back({path, row.line, std::move(row.cells)});
  }
  return rows;
}

std::vector<TextRow> SplitRowsAtBlanks(const std::filesystem::path& path,
                                       const std::string& content) {
  std::vector<TextRow> rows;
  std::istringstream stream(content);
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    const std::string_view trimmed = TrimmedView(text);
    if (trimmed.empty() || trimmed[0] == '#') continue;
    rows.push_back({path, line, SplitAtBlanks(trimmed)});
  }
  return rows;
}

// The separator of the table: of the first line that is neither empty nor a comment.
char GuessedSeparator(const std::string& content) {
  const char stated = StatedSeparator(content);
  if (stated != '\0') return stated;
  std::istringstream stream(content);
  std::string text;
  while (std::getline(stream, text)) {
    const std::string_view trimmed = TrimmedView(text);
    if (!trimmed.empty() && trimmed[0] != '#') return SeparatorOfLine(trimmed);
  }
  return ' ';
}

std::vector<TextRow> GuessedRows(const std::filesystem::path& path, const std::string& content) {
  const char separator = GuessedSeparator(content);
  if (separator == ' ') return SplitRowsAtBlanks(path, content);
  std::vector<TextRow> rows = SplitRowsAt(path, content, separator);
  if (separator == '\t' && !rows.empty() && AreAligned(rows[0].words)) {
    return SplitRowsAtBlanks(path, content);
  }
  return rows;
}

}  // namespace

InputError TextRow::Error(const std::string& message) const {
  return InputError(path, line, message);
}

const std::string& TextRow::Text(size_t index, const std::string& what) const {
  if (index >= words.size() || words[index].empty()) {
    throw ErrorAt(place(), Sentence("wordMissing",
                                    "{what} is missing, expected it as value {index} of the line",
                                    {{"what", what}, {"index", int(index) + 1}}));
  }
  return words[index];
}

double TextRow::Number(size_t index, const std::string& what) const {
  const std::string& text = Text(index, what);
  const auto value = ParseNumber(text);
  if (value) return *value;
  throw ErrorAt(place(), Sentence("wordNumber", "\"{text}\" for {what}, expected a finite number",
                                  {{"text", text}, {"what", what}}));
}

int TextRow::Integer(size_t index, const std::string& what) const {
  const double value = Number(index, what);
  const bool fits = std::abs(value) <= std::numeric_limits<int>::max();
  if (!fits || value != std::floor(value)) {
    throw ErrorAt(place(), Sentence("wordWhole", "\"{text}\" for {what}, expected a whole number",
                                    {{"text", words[index]}, {"what", what}}));
  }
  return static_cast<int>(value);
}

std::vector<TextRow> SplitTextRows(const std::filesystem::path& path, const std::string& content,
                                   WordSeparator separator) {
  std::vector<TextRow> rows;
  switch (separator) {
    case WordSeparator::kComma:
      return SplitRowsAt(path, content, ',');
    case WordSeparator::kBlanks:
      return SplitRowsAtBlanks(path, content);
    case WordSeparator::kSemicolon:
      rows = SplitRowsAt(path, content, ';');
      break;
    case WordSeparator::kGuess:
      rows = GuessedRows(path, content);
      break;
  }
  NumberStyle style;
  for (const TextRow& row : rows) {
    for (const std::string& word : row.words) style.Learn(word);
  }
  for (TextRow& row : rows) MakePlain(style, &row.words);
  return rows;
}

std::vector<TextRow> ReadTextRows(const std::filesystem::path& path, WordSeparator separator) {
  return SplitTextRows(path, ReadTextFile(path), separator);
}

std::string ReadTextFile(const std::filesystem::path& path) { return ReadPlainText(path); }

}  // namespace insitu
