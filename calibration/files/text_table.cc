// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/text_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

// "12,5" as "12.5", if that makes it a number.
std::string WithDecimalPoint(const std::string& word) {
  const size_t comma = word.find(',');
  if (comma == std::string::npos) return word;
  std::string number = word;
  number[comma] = '.';
  return ParseNumber(number) ? number : word;
}

std::vector<std::string> SplitLine(std::string_view text, WordSeparator separator) {
  if (separator == WordSeparator::kComma) return SplitAt(text, ',');
  if (separator == WordSeparator::kSemicolon) {
    std::vector<std::string> words = SplitAt(text, ';');
    std::transform(words.begin(), words.end(), words.begin(), WithDecimalPoint);
    return words;
  }
  if (separator == WordSeparator::kGuess) {
    for (const char candidate : {',', ';', '\t'}) {
      if (text.find(candidate) != std::string_view::npos) return SplitAt(text, candidate);
    }
  }
  return SplitAtBlanks(text);
}

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

InputError TextRow::Error(const std::string& message) const {
  return InputError(path, line, message);
}

const std::string& TextRow::Text(size_t index, const std::string& what) const {
  if (index >= words.size() || words[index].empty()) {
    throw Error(what + " is missing, expected it as value " + std::to_string(index + 1) +
                " of the line");
  }
  return words[index];
}

double TextRow::Number(size_t index, const std::string& what) const {
  const std::string& text = Text(index, what);
  const auto value = ParseNumber(text);
  if (!value) throw Error("\"" + text + "\" for " + what + ", expected a finite number");
  return *value;
}

int TextRow::Integer(size_t index, const std::string& what) const {
  const double value = Number(index, what);
  const bool fits = std::abs(value) <= std::numeric_limits<int>::max();
  if (!fits || value != std::floor(value)) {
    throw Error("\"" + words[index] + "\" for " + what + ", expected a whole number");
  }
  return static_cast<int>(value);
}

std::vector<TextRow> SplitTextRows(const std::filesystem::path& path, const std::string& content,
                                   WordSeparator separator) {
  std::vector<TextRow> rows;
  std::istringstream stream(content);
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    const std::string_view trimmed = TrimmedView(text);
    if (trimmed.empty() || trimmed[0] == '#') continue;
    rows.push_back({path, line, SplitLine(trimmed, separator)});
  }
  return rows;
}

std::vector<TextRow> ReadTextRows(const std::filesystem::path& path, WordSeparator separator) {
  return SplitTextRows(path, ReadTextFile(path), separator);
}

std::string ReadTextFile(const std::filesystem::path& path) {
  std::string content = ReadWhole(path);
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  if (content.find('\0') != std::string::npos) {
    throw InputError(path, "is not a text file (it holds a zero byte)");
  }
  return content;
}

}  // namespace insitu
