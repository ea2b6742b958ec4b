// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/delimited_rows.h"

#include <algorithm>

#include "calibration/files/words.h"

namespace insitu {
namespace {

std::string_view LineAt(std::string_view content, size_t begin) {
  return content.substr(begin, std::min(content.find('\n', begin), content.size()) - begin);
}

// One row after the other of a text.
class Reader {
 public:
  Reader(const std::filesystem::path& path, std::string_view content, char separator)
      : path_(path), content_(content), separator_(separator) {
    if (StatedSeparator(content) != '\0') SkipLine();
  }

  bool IsAtEnd() const { return at_ >= content_.size(); }

  // Without cells: a comment, or nothing in it.
  DelimitedRow Next() {
    DelimitedRow row{line_, {}};
    const std::string_view line = TrimmedView(LineAt(content_, at_));
    if (line.empty() || line[0] == '#') {
      SkipLine();
      return row;
    }
    while (true) {
      row.cells.push_back(Cell());
      const bool goes_on = !IsAtEnd() && content_[at_] == separator_;
      if (!IsAtEnd()) ++at_;
      if (!goes_on) break;
    }
    ++line_;
    if (std::all_of(row.cells.begin(), row.cells.end(), [](const auto& c) { return c.empty(); })) {
      row.cells.clear();
    }
    return row;
  }

 private:
  void SkipLine() {
    at_ += LineAt(content_, at_).size() + 1;
    ++line_;
  }

  bool IsBlank() const {
    return (content_[at_] == ' ' || content_[at_] == '\t') && content_[at_] != separator_;
  }

  // Up to the separator or the line's end.
  std::string Cell() {
    while (!IsAtEnd() && IsBlank()) ++at_;
    if (!IsAtEnd() && content_[at_] == '"') return InQuotes();
    const size_t begin = at_;
    while (!IsAtEnd() && content_[at_] != separator_ && content_[at_] != '\n') ++at_;
    return std::string(TrimmedView(content_.substr(begin, at_ - begin)));
  }

  std::string InQuotes() {
    const int first_line = line_;
    std::string cell;
    for (++at_;; ++at_) {
      if (IsAtEnd()) throw InputError(path_, first_line, "a quote \" is opened and never closed");
      if (content_[at_] == '\n') ++line_;
      if (content_[at_] != '"') {
        cell += content_[at_];
      } else if (at_ + 1 < content_.size() && content_[at_ + 1] == '"') {
        cell += content_[++at_];
      } else {
        break;
      }
    }
    ++at_;
    while (!IsAtEnd() && IsBlank()) ++at_;
    if (IsAtEnd() || content_[at_] == separator_ || content_[at_] == '\n') return cell;
    throw InputError(path_, line_,
                     "there is more behind a cell in quotes, expected quotes about the whole cell, "
                     "and two for one within it");
  }

  const std::filesystem::path& path_;
  const std::string_view content_;
  const char separator_;
  size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

char SeparatorOfLine(std::string_view line) {
  size_t counts[3] = {0, 0, 0};
  constexpr char kSeparators[] = {'\t', ';', ','};
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    for (int i = 0; i < 3 && !is_quoted; ++i) counts[i] += c == kSeparators[i];
  }
  const auto most = std::max_element(counts, counts + 3);
  return *most == 0 ? ' ' : kSeparators[most - counts];
}

char StatedSeparator(std::string_view content) {
  const std::string_view line = TrimmedView(LineAt(content, 0));
  if (line == "sep=") return '\t';  // the tabulator was trimmed off
  const bool is_stated = line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP="));
  return is_stated ? line[4] : '\0';
}

std::vector<DelimitedRow> SplitDelimited(const std::filesystem::path& path,
                                         std::string_view content, char separator) {
  std::vector<DelimitedRow> rows;
  Reader reader(path, content, separator);
  while (!reader.IsAtEnd()) {
    DelimitedRow row = reader.Next();
    if (!row.cells.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

std::string QuotedCell(const std::string& text, char separator) {
  const bool is_plain = !text.empty() && text.find_first_of("\"\n\r") == std::string::npos &&
                        text.find(separator) == std::string::npos && text[0] != '#' &&
                        TrimmedView(text).size() == text.size();
  if (is_plain || text.empty()) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted += '"';
}

}  // namespace insitu
