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

namespace insitu {

// nullopt: not a finite number as a whole.
std::optional<double> ParseNumber(std::string_view text);

std::string Digits(double value);  // the fewest that give the number back

std::string_view TrimmedView(std::string_view text);  // without blanks at its ends

// Pieces between separators, trimmed, empty ones included; none of an empty text.
std::vector<std::string> SplitAt(std::string_view text, char separator);

// Pieces between blanks; a piece in double quotes may hold blanks.
std::vector<std::string> SplitAtBlanks(std::string_view text);

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

// How the words of a line are told apart; kGuess: by commas, else semicolons, else tabulators, else
// blanks, whichever a line has. Between semicolons a number may have a decimal comma, as
// spreadsheets of many countries write it; it becomes a point.
enum class WordSeparator { kGuess, kComma, kSemicolon, kBlanks };

// The lines that hold something and do not begin with #. Throws InputError: unreadable, not text.
std::vector<TextRow> ReadTextRows(const std::filesystem::path& path, WordSeparator separator);

// The same of a text that was read already; `path` is for messages.
std::vector<TextRow> SplitTextRows(const std::filesystem::path& path, const std::string& content,
                                   WordSeparator separator);

// The whole of a text file, without a byte order mark. Throws InputError: unreadable, holds NUL.
std::string ReadTextFile(const std::filesystem::path& path);

}  // namespace insitu
