// SPDX-License-Identifier: GPL-3.0-or-later
// Two people's changes of the same rows, brought together row by row.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reconstruction/editing/operation.h"
#include "reconstruction/editing/survey_text.h"

namespace insitu {

struct MergedText {
  std::unique_ptr<SurveyText> text = {};  // theirs, with our changes in it
  std::vector<RowEdit> ours = {};         // those changes
  std::vector<RowEdit> outside = {};      // what differs from ours
  // Rows both changed: `before` of both, `current` theirs, `after` ours.
  std::vector<RowConflict> conflicts = {};
};

// `base` is what both began with. Where both changed a row, theirs stands. Throws InputError at the
// line: their text cannot be understood.
MergedText MergeText(const std::vector<EditedTable>& tables, const std::filesystem::path& path,
                     const std::string& base, const SurveyText& ours, const std::string& theirs);

struct MergedRows {
  std::vector<RowEdit> edits = {};          // rows that are new
  std::vector<RowConflict> conflicts = {};  // before: null, `current` ours, `after` theirs
};

// The rows of a survey that somebody else made of the same site. Marks less than three sigma apart
// are the same; ours stays.
MergedRows MergeSurvey(const std::vector<EditedTable>& tables, const SurveyText& ours,
                       const SurveyText& theirs);

}  // namespace insitu
