// SPDX-License-Identifier: GPL-3.0-or-later
// Observations in words: which one it is, and what to do when it was flagged.
#pragma once

#include <string>

#include "reconstruction/adjustment/adjusted_survey.h"

namespace insitu {

// "mark 'a3' on photo 'left' (x)": which observation a row is.
std::string Describe(const ObservationResidual& row);

// What the surveyor should do about an observation that was flagged.
std::string Advice(const ObservationResidual& row);

}  // namespace insitu
