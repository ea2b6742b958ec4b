// SPDX-License-Identifier: GPL-3.0-or-later
// What people are told of operations and of the files behind them.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "reconstruction/editing/site_edit.h"

namespace insitu {

// [{table, before, current, after}]
Json::Value ConflictsJson(const std::vector<RowConflict>& conflicts);

// Of the pixels that an operation places; empty if all lie on their photographs of those sizes
// [px]. Photographs of unknown size take any.
Sentence OffFrame(const Operation& operation, const std::map<std::string, Eigen::Vector2i>& sizes);

// Remarks and conflicts.
std::vector<Sentence> SentencesOf(const OutsideChanges& outside);

// Of files that could not be written, each with why; empty if there are none.
Sentence NotSaved(const std::vector<FileFault>& faults);

// Files that do not parse, and why: [{table, file, line, text}], and a line a file in English.
Json::Value ReadOnlyJson(const SiteEdit& edit);
std::string ReadOnlyText(const SiteEdit& edit);

}  // namespace insitu
