// SPDX-License-Identifier: GPL-3.0-or-later
// What of a large network the report tells one by one: what fits worst. The rest is in the CSV
// files.
#pragma once

#include <json/value.h>

#include <set>
#include <string>

#include "reconstruction/adjustment/adjusted_survey.h"

namespace insitu {

// Of a small network everything.
struct ReportExtent {
  bool is_large = false;
  std::set<std::string> photos_in_full;  // with picture and residual grid; all of a small network
  size_t points = 0;  // surveyed ones that are listed, of the largest sigma first

  size_t MarksOf(const std::string& photo) const;  // listed, of the largest |w| first
};

ReportExtent ExtentOf(const Adjustment& adjustment);

// Of a large network's report: photos worst first, of lists that grow with it the worst, and in
// "page_note" what is left out and where it stands. `adjustment` is what it was made from.
void CondenseReport(const Adjustment& adjustment, const ReportExtent& extent, Json::Value* report);

// A condensed report's numbers to six digits, for a browser; others as they are.
Json::Value ForPage(Json::Value report);

}  // namespace insitu
