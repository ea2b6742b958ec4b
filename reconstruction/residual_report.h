// SPDX-License-Identifier: GPL-3.0-or-later
// The residual report: JSON is the source, the self-contained page is made from it alone.
#pragma once

#include <json/value.h>

#include <string>

#include "reconstruction/adjustment.h"

namespace insitu {

Json::Value ResidualReport(const Adjustment& adjustment, const Survey& survey);

// One HTML file without outside references: tables and residual plots, verdict first.
std::string ResidualPage(const Json::Value& report);

}  // namespace insitu
