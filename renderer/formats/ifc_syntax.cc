// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/ifc_syntax.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <string>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

int LineAt(const std::string& text, size_t offset) {
  return 1 + static_cast<int>(
                 std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(offset), '\n'));
}

// The first name in FILE_SCHEMA(('IFC2X3')).
std::string SchemaIn(const std::filesystem::path& path, const std::string& head, size_t at) {
  const size_t open = head.find('\'', at);
  const size_t close = open == std::string::npos ? open : head.find('\'', open + 1);
  if (close == std::string::npos) {
    throw InputError(path, LineAt(head, at),
                     "FILE_SCHEMA names no schema, expected IFC2X3 or IFC4");
  }
  std::string schema = head.substr(open + 1, close - open - 1);
  for (char& c : schema) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    if (c < ' ' || c > '~') c = '?';
  }
  return schema.substr(0, 40);
}

// Statements one by one, without comments and blanks, with the line each begins at.
class Statements {
 public:
  explicit Statements(const std::filesystem::path& path) : file_(path, std::ios::binary) {}

  // Up to its ";", or to the end of the file; false: nothing more.
  bool Next() {
    text_.clear();
    for (int c; (c = Take()) != EOF;) {
      if (c == ';') return true;
      if (c == '/' && file_.peek() == '*') {
        SkipComment();
      } else if (c == '\'') {
        SkipText();
      } else if (c > ' ') {
        if (text_.empty()) line_of_start_ = line_;
        text_ += static_cast<char>(c);
      }
    }
    return !text_.empty();
  }
  const std::string& text() const { return text_; }  // texts in quotes left out
  int line() const { return line_of_start_; }

 private:
  int Take() {
    const int c = file_.get();
    line_ += c == '\n';
    return c;
  }
  void SkipComment() {
    for (int c = Take(), before = 0; c != EOF && !(before == '*' && c == '/'); c = Take()) {
      before = before == 0 ? ' ' : c;  // the star that opens it closes nothing
    }
  }
  void SkipText() {
    for (int c = Take(); c != EOF && c != '\''; c = Take()) continue;
  }

  std::ifstream file_;
  std::string text_;
  int line_ = 1, line_of_start_ = 1;
};

// "#12=NAME(...)", or with several in place of NAME(...).
bool IsInstance(const std::string& text) {
  size_t i = text.find_first_not_of("0123456789", 1);
  if (!text.starts_with('#') || i == 1 || i == std::string::npos || text[i] != '=') return false;
  const auto is_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  while (++i < text.size() && is_name(text[i])) continue;
  return i < text.size() && text[i] == '(' && text.back() == ')' &&
         std::ranges::count(text, '(') == std::ranges::count(text, ')');
}

}  // namespace

void CheckIfcSchema(const std::filesystem::path& path) {
  constexpr size_t kHead = 1 << 16;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, "cannot be read");
  std::string head(kHead, '\0');
  file.read(head.data(), kHead);
  head.resize(static_cast<size_t>(file.gcount()));
  const size_t at = head.find("FILE_SCHEMA");
  if (at == std::string::npos) {
    throw InputError(path, "has no FILE_SCHEMA, expected an IFC file of schema IFC2X3 or IFC4");
  }
  const std::string schema = SchemaIn(path, head, at);
  if (schema.starts_with("IFC2X3") || schema.starts_with("IFC4")) return;
  throw InputError(path, LineAt(head, at),
                   "is of schema " + schema +
                       ", expected IFC2X3, IFC4 or IFC4X3: export it as one of these, glTF or DXF");
}

void CheckIfcStatements(const std::filesystem::path& path) {
  Statements statements(path);
  bool in_data = false;
  while (statements.Next()) {
    const std::string& text = statements.text();
    if (text == "ENDSEC") {
      in_data = false;
    } else if (!in_data) {
      in_data = text == "DATA";
    } else if (!IsInstance(text)) {
      throw InputError(path, statements.line(),
                       Quoted(text) + ", expected an instance such as #12=IFCWALL(...)");
    }
  }
}

}  // namespace insitu
