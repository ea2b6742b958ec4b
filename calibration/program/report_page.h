// SPDX-License-Identifier: GPL-3.0-or-later
// Pages that show a report: one HTML file each, without outside references, made from the report's
// JSON alone. Tables and plots are drawn by a script in the page, with Observable Plot.
#pragma once

#include <json/value.h>

#include <string>
#include <string_view>

namespace insitu {

// `script` is JavaScript that finds the parsed JSON in `report` and builds the page with the
// functions of report_page/page.js. It is trusted, the JSON and the title are not: whatever names
// they hold stay text.
std::string ReportPage(const std::string& title, const Json::Value& report,
                       std::string_view script);

}  // namespace insitu
