// SPDX-License-Identifier: GPL-3.0-or-later
// Which column of a table is which, and in what unit: decided from the titles, or asked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "reconstruction/survey/column_title.h"

namespace insitu {

// What the user says about tables whose titles leave it open.
struct SurveyReading {
  std::map<std::string, std::string> columns;  // quantity, as ColumnByName knows it -> title
  std::optional<std::string> unit;             // of lengths whose columns state none
};

struct SurveyColumns {
  std::map<Column, size_t> index;
  std::map<Column, ColumnUnit> unit;  // of those that state one, or by the options
  bool has_degrees = false;           // x and y are longitude and latitude
  bool has_marks = false;             // of photographs, in pixels
  std::vector<std::string> left_out;  // titles of columns that could be meant too
};

// nullopt: titles of no survey. Throws InputError at `place`: two columns of one quantity, y before
// x, a unit that is none or does not suit its quantity, a title of the options that is not there.
std::optional<SurveyColumns> DecideColumns(const std::vector<std::string>& titles,
                                           const FilePlace& place, const SurveyReading& reading);

// What a table lacks whose titles are nearly those of a survey: "no column is the height". nullopt:
// no such titles.
std::optional<Sentence> MissingColumn(const std::vector<std::string>& titles);

}  // namespace insitu
