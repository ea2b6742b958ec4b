// SPDX-License-Identifier: GPL-3.0-or-later
// Tables as other programs write them: words of a line, by commas or by blanks, without a header
// that one could rely on. Faults name file and line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/words.h"

namespace insitu {

struct TextRow {
  std::filesystem::path path;
  int line = 0;
  std::vector<std::string> words;

  // The word at `index`, `what` it is for the message. Throw InputError: missing, empty, no number.
  const std::string& Text(size_t index, const std::string& what) const;
  double Number(size_t index, const std::string& what) const;
  int Integer(size_t index, const std::string& what) const;
  InputError Error(const std::string& message) const;
  FilePlace place() const { return {path, line}; }
};

// How the words of a line are told apart; kGuess: by what separates most of the first line,
// tabulators, semicolons or commas, else blanks. Cells may be in quotes. Between semicolons, and
// guessed, numbers may have decimal commas and marks between thousands, as spreadsheets of many
// countries write them; they become plain.
enum class WordSeparator { kGuess, kComma, kSemicolon, kBlanks };

// The lines that hold something and do not begin with #. Throws InputError: unreadable, not text.
std::vector<TextRow> ReadTextRows(const std::filesystem::path& path, WordSeparator separator);

// The same of a text that was read already; `path` is for messages.
std::vector<TextRow> SplitTextRows(const std::filesystem::path& path, const std::string& content,
                                   WordSeparator separator);

// The whole of a text file, as plain_text.h has it. Throws InputError: unreadable, holds NUL.
std::string ReadTextFile(const std::filesystem::path& path);

}  // namespace insitu
