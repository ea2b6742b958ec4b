// SPDX-License-Identifier: GPL-3.0-or-later
// A file of a site as a text of its form.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reconstruction/editing/survey_text.h"

namespace insitu {

// Of the file with these tables. Throws InputError at the line: the text cannot be understood, or
// is not UTF-8. `path` is for messages.
std::unique_ptr<SurveyText> MakeSurveyText(const std::vector<EditedTable>& tables,
                                           const std::filesystem::path& path,
                                           const std::string& text);

}  // namespace insitu
