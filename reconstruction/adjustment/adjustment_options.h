// SPDX-License-Identifier: GPL-3.0-or-later
// How true to its model a site is taken to be, and what is adjusted of it.
#pragma once

namespace insitu {

struct AdjustmentOptions {
  double plane_sigma = 0.005;        // [m], distance of a vertex from its polygon's plane
  bool has_hard_planes = false;      // planes hold their vertices to a hundredth of a millimetre
  double zenith_sigma = 0.005;       // [m], across, of a vertical edge's ends
  double sun_sigma = 0.02;           // [m], across, of a shadow point from the line to the sun
  bool is_self_calibrating = false;  // the lens parameters are unknowns too
  double significance = 0.001;       // alpha0 of each w-test (Baarda); its power is 80 %

  // Throws CheckError that names the field: a sigma that is not above 0 and finite, a significance
  // that is not between 0 and 1.
  void Check() const;
};

}  // namespace insitu
