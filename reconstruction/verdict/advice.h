// SPDX-License-Identifier: GPL-3.0-or-later
// Observations in words: which one it is, and what to do when it was flagged.
#pragma once

#include <string>

#include "reconstruction/adjustment/adjusted_survey.h"

namespace insitu {

// The group of observations that a row belongs to, as the report and its tables call it:
// "image x", "edge", "control z", "camera x", "lens", "plane", "sun", ...
std::string Group(const ObservationResidual& row);

// What a row is of, in one word or several: "a3", "roof a3" of a vertex on its polygon's plane.
std::string Subject(const ObservationResidual& row);

// "mark 'a3' on photo 'left' (x)": which observation a row is.
std::string Describe(const ObservationResidual& row);

// What the surveyor should do about an observation that was flagged.
std::string Advice(const ObservationResidual& row);

}  // namespace insitu
