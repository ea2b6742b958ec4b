// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/ifc_header.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "calibration/error.h"

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
    throw InputError(path, LineAt(head, at), "FILE_SCHEMA names no schema, expected IFC2X3");
  }
  std::string schema = head.substr(open + 1, close - open - 1);
  for (char& c : schema) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    if (c < ' ' || c > '~') c = '?';
  }
  return schema.substr(0, 40);
}

void CheckSchema(const std::filesystem::path& path, std::ifstream* file) {
  constexpr size_t kHead = 1 << 16;
  std::string head(kHead, '\0');
  file->read(head.data(), kHead);
  head.resize(static_cast<size_t>(file->gcount()));
  file->clear();
  const size_t at = head.find("FILE_SCHEMA");
  if (at == std::string::npos) {
    throw InputError(path, "has no FILE_SCHEMA, expected an IFC file of schema IFC2X3");
  }
  const std::string schema = SchemaIn(path, head, at);
  if (!schema.starts_with("IFC2X3")) {
    throw InputError(
        path, LineAt(head, at),
        "is of schema " + schema +
            ", expected IFC2X3: export it as IFC 2x3 (coordination view), glTF or DXF");
  }
}

}  // namespace

void CheckIfcHeader(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, "cannot be read");
  CheckSchema(path, &file);
  const auto size = static_cast<int64_t>(std::filesystem::file_size(path));
  const int64_t length = std::min<int64_t>(size, 4096);
  std::string tail(static_cast<size_t>(length), '\0');
  file.seekg(size - length);
  file.read(tail.data(), length);
  if (tail.find("END-ISO-10303-21") != std::string::npos) return;
  int lines = 0;
  file.clear();
  file.seekg(0);
  for (std::string line; std::getline(file, line);) ++lines;
  throw InputError(path, lines, "the file ends here, expected END-ISO-10303-21: it is cut short");
}

}  // namespace insitu
