// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and lists within sentences.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace insitu {

// printf into a string, however long.
[[gnu::format(printf, 1, 2)]] std::string Formatted(const char* format, ...);

// The same with one number.
std::string Number(const char* format, double value);

// As people write it: three significant digits, or two decimals.
std::string ShortNumber(double value);

// "'a' and 'b'", "'a', 'b', 'c', 'd' and 3 others".
std::string QuotedList(const std::vector<std::string>& names);

// "what (n): a, b, c and m more", at most `shown` names.
std::string Listing(const std::string& what, const std::vector<std::string>& names,
                    size_t shown = 8);

// A file's own words in a message: in quotes, short, and printable whatever the file holds.
std::string Quoted(std::string_view text);

}  // namespace insitu
