// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/finding.h"

#include <algorithm>

namespace insitu {
namespace {

// A word that is none of ours counts as a review.
Severity SeverityOf(const std::string& word) {
  for (const Severity severity : {Severity::kNote, Severity::kFail}) {
    if (word == Word(severity)) return severity;
  }
  return Severity::kReview;
}

}  // namespace

const char* Word(Severity severity) {
  switch (severity) {
    case Severity::kNote:
      return "note";
    case Severity::kReview:
      return "review";
    case Severity::kFail:
      break;
  }
  return "fail";
}

Json::Value VerdictReport(const std::vector<Finding>& findings) {
  Json::Value verdict;
  Severity worst = Severity::kNote;
  verdict["reasons"] = Json::Value(Json::arrayValue);
  for (const Finding& finding : findings) {
    worst = std::max(worst, finding.severity);
    Json::Value reason;
    reason["severity"] = Word(finding.severity);
    reason["reason"] = finding.reason;
    reason["remedy"] = finding.remedy;
    verdict["reasons"].append(reason);
  }
  verdict["status"] = worst == Severity::kNote ? "pass" : Word(worst);
  return verdict;
}

std::vector<Finding> FindingsOf(const Json::Value& verdict) {
  std::vector<Finding> findings;
  for (const Json::Value& reason : verdict["reasons"]) {
    findings.push_back({SeverityOf(reason["severity"].asString()), reason["reason"].asString(),
                        reason["remedy"].asString()});
  }
  return findings;
}

}  // namespace insitu
