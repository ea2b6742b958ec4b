// SPDX-License-Identifier: GPL-3.0-or-later
// Texts within pages.
#pragma once

#include <string>
#include <string_view>

namespace insitu {

// The text as it stands between the tags of a page or between the quotes of an attribute.
std::string HtmlText(std::string_view text);

}  // namespace insitu
