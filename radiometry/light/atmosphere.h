// SPDX-License-Identifier: GPL-3.0-or-later
// The atmospheric model: homogeneous, isotropic haze. [Durisch92, §3.2]
#pragma once

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

struct Atmosphere {
  Spectrum horizon = Spectrum::Zero();        // horizon colour, radiance
  Spectrum transmittance = Spectrum::Ones();  // per metre (d_a = 1 m), in (0, 1]
};

// tau^d; distance >= 0 [m].
Spectrum TransmittanceOver(const Atmosphere& air, double distance);

// Apparent colour of a surface of true colour L0 at a distance [m].
// [Durisch92, Eq. (2)]  L = L0 tau^d + L_inf (1 - tau^d)
Spectrum ApparentColor(const Spectrum& true_color, const Atmosphere& air, double distance);

// Second inversion of the atmospheric model. [Durisch92, Eq. (8)]
// L0 = (L - L_inf) tau^-d + L_inf; may be negative where the photo is darker than its own haze.
Spectrum TrueColor(const Spectrum& apparent_color, const Atmosphere& air, double distance);

}  // namespace insitu
