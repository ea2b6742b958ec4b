// SPDX-License-Identifier: GPL-3.0-or-later
// The diffuse part of the illumination model; what mirrors is in fresnel.h and microfacet.h.
#pragma once

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// Radiance that a diffuse surface reflects. [Durisch92, Eq. (6)]  L = k_d rho E
// rho is a BRDF [1/sr], albedo / pi; E may be negative (case D3).
Spectrum ReflectedRadiance(double diffuse_weight, const Spectrum& brdf, const Spectrum& irradiance);

// Second inversion of the illumination model. [Durisch92, Eq. (10)]  rho = L0 / (k_d E)
// Zero in bins without light. diffuse_weight > 0.
Spectrum DiffuseBrdf(const Spectrum& true_color, double diffuse_weight, const Spectrum& irradiance);

}  // namespace insitu
