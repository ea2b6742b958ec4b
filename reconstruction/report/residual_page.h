// SPDX-License-Identifier: GPL-3.0-or-later
// The residual report as a page.
#pragma once

#include <json/value.h>

#include <string>

namespace insitu {

// One HTML file without outside references: verdict first, tables and plots.
std::string ResidualPage(const Json::Value& report);

}  // namespace insitu
