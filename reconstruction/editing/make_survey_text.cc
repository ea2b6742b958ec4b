// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/make_survey_text.h"

#include <algorithm>

#include "calibration/files/error.h"
#include "reconstruction/editing/csv_survey_text.h"
#include "reconstruction/editing/json_survey_text.h"

namespace insitu {

std::unique_ptr<SurveyText> MakeSurveyText(const std::vector<EditedTable>& tables,
                                           const std::filesystem::path& path,
                                           const std::string& text) {
  INSITU_CHECK(!tables.empty());
  if (const auto at = FirstNotUtf8(text)) {
    const auto fault = text.begin() + static_cast<std::ptrdiff_t>(*at);
    throw InputError(path, 1 + static_cast<int>(std::count(text.begin(), fault, '\n')),
                     "is not UTF-8, expected the file saved as UTF-8 text");
  }
  if (tables.front().form == TableForm::kCsv) {
    return std::make_unique<CsvSurveyText>(tables.front(), path, text);
  }
  return std::make_unique<JsonSurveyText>(tables, path, text);
}

}  // namespace insitu
