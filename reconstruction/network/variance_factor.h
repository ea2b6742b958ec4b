// SPDX-License-Identifier: GPL-3.0-or-later
// By what cofactors are multiplied to be covariances.
#pragma once

#include <algorithm>

namespace insitu {

// With less, a sigma0 below 1 is chance: half of all networks of 6 have one under 0.94, one of 20
// under 0.52.
inline constexpr int kWellKnownRedundancy = 20;

// sigma0^2; with few redundancies not below the a priori 1.
inline double VarianceFactor(double sigma0, int redundancy) {
  const double posterior = sigma0 * sigma0;
  return redundancy < kWellKnownRedundancy ? std::max(1.0, posterior) : posterior;
}

}  // namespace insitu
