// SPDX-License-Identifier: GPL-3.0-or-later
// What a photogrammetrist would object to in an adjustment.
#pragma once

#include <json/value.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/adjustment.h"

namespace insitu {

enum class Severity { kPass, kReview, kFail };

struct Objection {
  Severity severity = Severity::kReview;
  std::string reason;
};

// The test value w = v / (sigma sqrt(r)) of data snooping, standard normal if the observation has
// no gross error; nullopt if it is not controlled (r below 1e-6).
std::optional<double> TestValue(const ObservationResidual& row);

// The largest angle between the rays to each point that is marked twice or more [rad].
std::map<std::string, double> LargestRayAngles(const Adjustment& adjustment, const Survey& survey);

// Empty: nothing to object to.
std::vector<Objection> Judge(const Adjustment& adjustment, const Survey& survey);

// {"status": "pass" | "review" | "fail", "reasons": [...]}, the worst first.
Json::Value VerdictReport(std::vector<Objection> objections);

}  // namespace insitu
