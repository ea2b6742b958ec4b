// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of OBJ and its material files, word by word.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
#include "renderer/dxf/dxf_name.h"
#include "renderer/foreign/text_lines.h"

namespace insitu {

constexpr double kLargestOfObj = 1e12;

// Words of a line, blanks between.
class ObjWords {
 public:
  ObjWords(const std::filesystem::path& path, int line, std::string_view text)
      : path_(path), line_(line), rest_(text) {}

  std::optional<std::string_view> Next() {
    const size_t first = rest_.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return std::nullopt;
    const size_t end = std::min(rest_.find_first_of(" \t\r", first), rest_.size());
    const std::string_view word = rest_.substr(first, end - first);
    rest_.remove_prefix(end);
    return word;
  }
  // A comment behind numbers; in names "#" is a letter.
  void CutComment() {
    size_t at = rest_.find('#');
    while (at != rest_.npos && at > 0 && rest_[at - 1] == '.')
      at = rest_.find('#', at + 1);  // 1.#IND
    rest_ = rest_.substr(0, at);
  }
  std::string Rest() {
    const size_t first = rest_.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return "";
    return std::string(rest_.substr(first, rest_.find_last_not_of(" \t\r") - first + 1));
  }
  // The rest as a name; bytes that are no UTF-8 are Windows-1252; in composed form.
  std::string Name() { return Composed(Utf8FromDxf(Rest())); }
  // nullopt: no number, not finite, beyond any; the word is passed over.
  std::optional<double> FindNumber() {
    const auto word = Next();
    double value = 0;
    if (!word || !ParseAll(*word, &value) || !(std::abs(value) <= kLargestOfObj)) {
      return std::nullopt;
    }
    return value;
  }
  // NaN: what programs write in its place ("nan", "-1.#IND", "inf").
  double Number() {
    const auto word = Next();
    double value = 0;
    if (word && IsNoNumber(*word)) return std::numeric_limits<double>::quiet_NaN();
    if (!word || !ParseAll(*word, &value) || !(std::abs(value) <= kLargestOfObj)) {
      throw Error((word ? "\"" + std::string(word->substr(0, 40)) + "\"" : "the line ends") +
                  ", expected a number of at most 1e12");
    }
    return value;
  }
  Eigen::Vector3d Point() {
    const double x = Number(), y = Number();
    return {x, y, Number()};
  }
  InputError Error(const std::string& message) const { return {path_, line_, message}; }

  template <typename T>
  static bool ParseAll(std::string_view word, T* value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), *value);
    return status == std::errc() && end == word.data() + word.size();
  }

 private:
  const std::filesystem::path& path_;
  int line_;
  std::string_view rest_;
};

// Calls `use` with the words of each line, `comment` with comments; a backslash at a line's end
// continues it.
template <typename Use, typename Comment>
void ForEachObjLine(const std::filesystem::path& path, const Use& use, const Comment& comment) {
  TextLines lines(path);
  std::string line, more;
  for (int number = 1; lines.Next(&line); ++number) {
    const int first = number;
    while (line.ends_with('\\')) {
      line.pop_back();
      if (!lines.Next(&more)) break;
      line += " " + more;
      ++number;
    }
    ObjWords words(path, first, line);
    const auto keyword = words.Next();
    if (!keyword) continue;
    if (keyword->front() == '#') {
      comment(line);
    } else {
      use(*keyword, words, first);
    }
  }
}

}  // namespace insitu
