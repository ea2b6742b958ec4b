// SPDX-License-Identifier: GPL-3.0-or-later
// What an interface between two media mirrors, and a pane that has two of them. Unpolarised light;
// cosines are those of the angle of incidence, in [0, 1].
#pragma once

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// Of a dielectric, seen from outside; index relative to the medium outside, > 0.
// [Hall & Greenberg 1983, after Born & Wolf]
double FresnelReflectance(double cosine, double index);

// Of a metal in air, whose index is index - i extinction; index > 0, extinction >= 0.
// [Born & Wolf 1999, Eq. 14.4.1]
Spectrum ConductorReflectance(double cosine, const Spectrum& index, const Spectrum& extinction);

// Of the angle inside, by Snell's law; 0 where the light is totally reflected.
double RefractedCosine(double cosine, double index);

struct SheetOptics {
  Spectrum transmittance, reflectance;  // 0..1
};

// A pane in air with all reflections between its two faces summed: with a = exp(-k d / cos t) and F
// of one face, T = (1 - F)^2 a / (1 - F^2 a^2), R = F + F (1 - F)^2 a^2 / (1 - F^2 a^2).
// `absorption` k [1/m] >= 0, `thickness` d [m] >= 0, `index` > 1.
// [Born & Wolf 1999, 7.6.1, incoherent]
SheetOptics ThinSheet(double cosine, double index, const Spectrum& absorption, double thickness);

}  // namespace insitu
