// SPDX-License-Identifier: GPL-3.0-or-later
// Comma-separated tables with a header line; faults name file and line.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {

struct CsvRow {
  std::filesystem::path path;
  int line = 0;
  std::map<std::string, std::string> cells;  // column -> text, blanks trimmed

  const std::string& Text(const std::string& column) const;  // must not be empty
  double Number(const std::string& column) const;            // finite
  InputError Error(const std::string& message) const;
};

// Blank lines and lines beginning with # are skipped. Throws InputError: unreadable, a column of
// `columns` missing from the header, a row with another number of cells than the header.
std::vector<CsvRow> ReadCsv(const std::filesystem::path& path,
                            const std::vector<std::string>& columns);

}  // namespace insitu
