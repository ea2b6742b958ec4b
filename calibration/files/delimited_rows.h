// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of a table as text [RFC 4180]: in quotes a cell may hold separators, line ends and
// doubled quotes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {

struct DelimitedRow {
  int line = 0;                    // where it begins
  std::vector<std::string> cells;  // without quotes; blanks are trimmed off what had none
};

// What separates the cells of the line: the commonest of tabulators, semicolons and commas outside
// quotes, in that order where they are equally common; ' ' if it has none of them.
char SeparatorOfLine(std::string_view line);

// What a spreadsheet's first line "sep=;" says, else '\0'.
char StatedSeparator(std::string_view content);

// The rows of `content` (UTF-8, lines ended by \n) that hold something. Lines that begin with # are
// comments, and "sep=" in the first is none of them. Throws InputError at the line of a quote that
// is never closed, or with something but blanks and a separator behind it.
std::vector<DelimitedRow> SplitDelimited(const std::filesystem::path& path,
                                         std::string_view content, char separator);

// A cell as it is to be written: in quotes where it needs them.
std::string QuotedCell(const std::string& text, char separator = ',');

}  // namespace insitu
