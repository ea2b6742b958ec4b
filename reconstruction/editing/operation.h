// SPDX-License-Identifier: GPL-3.0-or-later
// A change of rows that is done as a whole or not at all.
#pragma once

#include <json/value.h>

#include <functional>
#include <string>
#include <vector>

#include "reconstruction/editing/survey_text.h"

namespace insitu {

struct RowEdit {
  std::string table;
  Json::Value before;  // null: the row is new
  Json::Value after;   // null: the row goes
};

struct Operation {
  std::string id;     // given by who asks for it
  std::string label;  // for people, as "Mark tower_1 on left"
  std::vector<RowEdit> edits = {};
};

// A row that is not what an operation says it was.
struct RowConflict {
  std::string table;
  Json::Value before;   // as the operation has it; null: expected to be new
  Json::Value current;  // as it is; null: there is none
  Json::Value after;    // as the operation wanted it; null: gone
};

// {"id", "label", "edits": [{"table", "before", "after"}, ...]}. Throws InputError: another shape.
Operation OperationFromJson(const Json::Value& json);
Json::Value ToJson(const Operation& operation);
Json::Value ToJson(const RowConflict& conflict);

// What takes it back, last edit first.
Operation Inverse(const Operation& operation);

// Whether an operation may add a row that its file knows already. Two equal rows may stand in a
// file, and taking back the deletion of one puts it back beside the other.
enum class EqualRows { kRefused, kAllowed };

struct AppliedEdits {
  std::vector<Json::Value> traces = {};  // of SurveyText::Edit, one an edit
  std::vector<RowConflict> conflicts = {};
};

// Does all edits on the texts that `text_of` gives for their tables, or none if one is in conflict.
// `traces` are of the operation that this one takes back, in this one's order; or empty.
AppliedEdits ApplyEdits(const std::vector<RowEdit>& edits,
                        const std::function<SurveyText&(const EditedTable&)>& text_of,
                        EqualRows equal_rows, const std::vector<Json::Value>& traces = {});

// Takes edits back byte for byte that were done just now.
void TakeBack(const std::vector<RowEdit>& edits, const std::vector<Json::Value>& traces,
              const std::function<SurveyText&(const EditedTable&)>& text_of);

}  // namespace insitu
