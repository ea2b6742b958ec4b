// SPDX-License-Identifier: GPL-3.0-or-later
// Names of layers and blocks, from the drawing's code page to UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace insitu {

// A name as UTF-8. Bytes that are no UTF-8 are read in the drawing's code page (ANSI_1250 to 1258,
// 874, 932, 936, 949, 950; else Windows-1252); \U+XXXX becomes its character in any drawing.
std::string Utf8FromDxf(std::string_view text, const std::string& code_page = "ANSI_1252");

}  // namespace insitu
