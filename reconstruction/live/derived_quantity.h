// SPDX-License-Identifier: GPL-3.0-or-later
// Distances, heights and angles between adjusted points, with the sigma that their joint covariance
// gives: neighbours are known together far better than one by one.
#pragma once

#include <optional>
#include <string>

#include "reconstruction/adjustment/solve_survey.h"

namespace insitu {

struct DerivedQuantity {
  double value = 0, sigma = 0;
};

// [m]; nullopt: a point that took no part in the adjustment, or twice the same place.
std::optional<DerivedQuantity> AdjustedDistance(const SolvedSurvey& solved, const std::string& from,
                                                const std::string& to);

// Of `to` over `from`, along the adjusted zenith [m]; nullopt: a point that took no part.
std::optional<DerivedQuantity> AdjustedHeight(const SolvedSurvey& solved, const std::string& from,
                                              const std::string& to);

// At `apex`, between the sides to `first` and `second` [rad], 0..pi; nullopt: a point that took no
// part, or a side without length.
std::optional<DerivedQuantity> AdjustedAngle(const SolvedSurvey& solved, const std::string& first,
                                             const std::string& apex, const std::string& second);

}  // namespace insitu
