// SPDX-License-Identifier: GPL-3.0-or-later
// Texts as programs of any country and age write them, brought to one form.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace insitu {

// The text of a file as UTF-8 in composed form (NFC), lines ended by \n: a byte order mark is taken
// off, UTF-16 is told by its mark or its zero bytes, what is no UTF-8 is taken as Windows-1252, and
// lines may end in CR LF or CR alone. Throws InputError: unreadable, broken UTF-16, no text (NUL).
std::string ReadPlainText(const std::filesystem::path& path);

// The same of what was read already; `path` is for messages.
std::string PlainText(const std::filesystem::path& path, std::string bytes);

// In composed form, as names are compared: macOS hands out decomposed ones. What is no UTF-8 stays
// as it is.
std::string Composed(const std::string& utf8);

bool IsUtf8(const std::string& text);

// Composed and in capitals, for names that differ in case alone ("Wände", "WÄNDE").
std::string InCapitals(const std::string& utf8);

// What programs write in the place of a number: "nan", "-nan(ind)", "-1.#IND", "inf".
bool IsNoNumber(std::string_view word);

// Lower-case letters without accents ("Höhe" becomes "hohe"), for words that are looked up.
std::string Folded(const std::string& utf8);

}  // namespace insitu
