// SPDX-License-Identifier: GPL-3.0-or-later
// Words and numbers in texts of other programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace insitu {

// nullopt: not a finite number as a whole.
std::optional<double> ParseNumber(std::string_view text);

std::string Digits(double value);  // the fewest that give the number back

std::string_view TrimmedView(std::string_view text);  // without blanks at its ends

// Pieces between separators, trimmed, empty ones included; none of an empty text.
std::vector<std::string> SplitAt(std::string_view text, char separator);

// Pieces between blanks; a piece in double quotes may hold blanks.
std::vector<std::string> SplitAtBlanks(std::string_view text);

}  // namespace insitu
