// SPDX-License-Identifier: GPL-3.0-or-later
// Tables with a header line, as people and spreadsheets write them: between commas, semicolons or
// tabulators, in any encoding, with quotes, decimal commas and marks between thousands; faults name
// file and line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/number_style.h"

namespace insitu {

struct CsvRow {
  std::filesystem::path path;
  int line = 0;
  std::vector<std::string> cells;                           // blanks trimmed
  std::shared_ptr<const std::vector<std::string>> columns;  // their titles, for all rows
  NumberStyle style;                                        // of all numbers of the table

  // nullptr: no such column, or its cell is empty.
  const std::string* Find(const std::string& column) const;
  const std::string& Text(const std::string& column) const;  // must not be empty
  double Number(const std::string& column) const;            // finite
  InputError Error(const std::string& message) const;
};

// Blank lines and lines beginning with # are skipped, empty cells behind the last column too.
// Throws InputError: unreadable, a column of `columns` missing from the header, a row with another
// number of cells than the header.
std::vector<CsvRow> ReadCsv(const std::filesystem::path& path,
                            const std::vector<std::string>& columns);

}  // namespace insitu
