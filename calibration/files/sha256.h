// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a file is the same as another time, or as on another machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace insitu {

// SHA-256 [FIPS 180-4] of a file's content, hexadecimal. Throws InputError if it cannot be read.
std::string Sha256(const std::filesystem::path& path);

// The same of what is in memory.
std::string Sha256OfText(std::string_view text);

}  // namespace insitu
