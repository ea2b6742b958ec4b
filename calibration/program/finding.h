// SPDX-License-Identifier: GPL-3.0-or-later
// What a report finds to object to, and the verdict that follows.
#pragma once

#include <json/value.h>

#include <string>
#include <vector>

namespace insitu {

// How much a finding counts; notes leave a verdict a pass.
enum class Severity { kNote, kReview, kFail };

// "note", "review" or "fail".
const char* Word(Severity severity);

struct Finding {
  Severity severity = Severity::kReview;
  std::string reason;
  std::string remedy;  // what to do; may be empty
};

// {"status": "pass" | "review" | "fail", "reasons": [{"severity", "reason", "remedy"}]}, in this
// order.
Json::Value VerdictReport(const std::vector<Finding>& findings);

// The findings of such a verdict, of another stage's report; none if it states none.
std::vector<Finding> FindingsOf(const Json::Value& verdict);

}  // namespace insitu
