// SPDX-License-Identifier: GPL-3.0-or-later
// Text as the programs of all systems write it.
#pragma once

#include <filesystem>
#include <istream>
#include <memory>
#include <string>
#include <string_view>

namespace insitu {

// UTF-16 of either byte order, after its mark, as UTF-8; faulty pairs become U+FFFD.
std::string Utf8FromUtf16(std::string_view bytes, bool little_endian);

// Whether a text is UTF-16: by its mark, or since its first letters have zeros between.
bool IsUtf16(std::string_view bytes);

// The same bytes without a byte order mark; what is UTF-16, as UTF-8.
std::string DecodedText(std::string bytes);

// Lines of a text file: UTF-8 or UTF-16, with or without a byte order mark, other bytes as they
// are; ended by LF, CR LF or CR alone.
class TextLines {
 public:
  // Throws InputError: unreadable.
  explicit TextLines(const std::filesystem::path& path);

  // The next line without its end; false: no more.
  bool Next(std::string* line);

 private:
  std::unique_ptr<std::istream> stream_;
  char end_ = '\n';
};

}  // namespace insitu
