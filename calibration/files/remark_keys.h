// SPDX-License-Identifier: GPL-3.0-or-later
// Keys that every object of a JSON file may have, and no reader takes for its own: what people and
// their editors note.
#pragma once

#include <string_view>

namespace insitu {

inline bool IsRemarkKey(std::string_view key) { return key == "comment" || key == "$schema"; }

}  // namespace insitu
