// SPDX-License-Identifier: GPL-3.0-or-later
// Files that were cut are refused: what is missing may be a roof.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace insitu {

// Throws InputError at the last line: a text file without `ending` near its end.
void RequireEnding(const std::filesystem::path& path, const std::string& ending);

// Throws InputError: a file shorter than its head states [bytes].
void RequireLength(const std::filesystem::path& path, uint64_t stated);

}  // namespace insitu
