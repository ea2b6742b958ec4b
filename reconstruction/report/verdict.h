// SPDX-License-Identifier: GPL-3.0-or-later
// What a photogrammetrist would object to in an adjustment, and what the surveyor can do about it.
#pragma once

#include <json/value.h>

#include <optional>
#include <string>
#include <vector>

#include "calibration/boards/calibration_verdict.h"
#include "reconstruction/report/image_marks.h"
#include "reconstruction/report/residual_report.h"

namespace insitu {

// Redundancy numbers below this say that an error would hardly show in the residual.
inline constexpr double kWeaklyControlled = 0.1;

struct Objection {
  Severity severity = Severity::kReview;
  std::string reason;
  std::string remedy;  // what to do; may be empty
};

// Empty: nothing to object to.
std::vector<Objection> Judge(const Adjustment& adjustment,
                             const ReportContext& context = ReportContext());

// {"status": "pass" | "review" | "fail", "reasons": [{"severity", "reason", "remedy"}]}, the worst
// first; notes leave it a pass.
Json::Value VerdictReport(std::vector<Objection> objections);

// The observation that data snooping suspects: the largest |w| over the critical value, of what the
// surveyor measured if any, else of tie points. One at a time, since a gross error spoils the
// residuals around it. [Baarda 1968]
std::optional<ObservationResidual> Suspect(const Adjustment& adjustment);

}  // namespace insitu
