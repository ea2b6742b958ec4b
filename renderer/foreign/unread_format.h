// SPDX-License-Identifier: GPL-3.0-or-later
// Formats that are not read: what such a file is, and which menu of which program exports what is.
#pragma once

#include <string>
#include <string_view>

namespace insitu {

// "a DWG drawing: save it as DXF ..."; empty: of no kind that is known. `head` are the file's first
// bytes, `ending` is its lower-case ending with the dot, which goes before them unless it is that
// of a format that is read.
std::string AdviceOnFormat(std::string_view head, std::string_view ending);

}  // namespace insitu
