// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of one line between commas, with where they stand in it: so that a cell is changed and
// all else of the line stays.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace insitu {

// With the blanks and quotes about them. A cell in quotes may hold commas [RFC 4180].
std::vector<std::string_view> RawCells(std::string_view text);

// What a cell says, without quotes.
std::string CellOf(std::string_view raw);

// `text` with the blanks that `old` had about it.
std::string InPlaceOf(std::string_view old, const std::string& text);

}  // namespace insitu
