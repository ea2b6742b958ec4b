// SPDX-License-Identifier: GPL-3.0-or-later
// How every program tells its warnings, so that whoever runs it finds them in what it prints.
#pragma once

#include <string>
#include <vector>

namespace insitu {

// "warning: TEXT", a line each, whatever line breaks a text has.
std::string WarningLines(const std::vector<std::string>& warnings);

}  // namespace insitu
