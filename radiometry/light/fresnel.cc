// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/fresnel.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"

namespace insitu {

double FresnelReflectance(double cosine, double index) {
  INSITU_CHECK(index > 0);
  // g^2 = n^2 - 1 + c^2; below zero (n < 1 only) the light is totally reflected.
  const double c = cosine;
  const double g2 = index * index - 1 + c * c;
  if (g2 <= 0) return index == 1 ? 0 : 1;
  const double g = std::sqrt(g2);
  const double across = (g - c) / (g + c);
  const double along = (c * (g + c) - 1) / (c * (g - c) + 1);
  return 0.5 * across * across * (1 + along * along);
}

Spectrum ConductorReflectance(double cosine, const Spectrum& index, const Spectrum& extinction) {
  INSITU_CHECK((extinction >= 0).all());
  const double c2 = cosine * cosine, s2 = 1 - c2;
  const Spectrum difference = index.square() - extinction.square() - s2;
  const Spectrum length = (difference.square() + 4 * (index * extinction).square()).sqrt();
  const Spectrum a = ((length + difference) / 2).max(0).sqrt();
  const Spectrum across = (length + c2 - 2 * cosine * a) / (length + c2 + 2 * cosine * a);
  const Spectrum straight = c2 * length + s2 * s2, oblique = 2 * cosine * s2 * a;
  const Spectrum along = across * (straight - oblique) / (straight + oblique).max(1e-300);
  return (across + along) / 2;
}

double RefractedCosine(double cosine, double index) {
  INSITU_CHECK(index > 0);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / index;
  return std::sqrt(std::max(0.0, 1 - sine * sine));
}

SheetOptics ThinSheet(double cosine, double index, const Spectrum& absorption, double thickness) {
  INSITU_CHECK(index > 1 && thickness >= 0 && (absorption >= 0).all());
  const double F = FresnelReflectance(cosine, index);
  const Spectrum a = (-absorption * (thickness / RefractedCosine(cosine, index))).exp();
  if (F >= 1) return {Spectrum::Zero(), Spectrum::Ones()};
  const Spectrum through = (1 - F) * (1 - F) * a / (1 - F * F * a.square());
  return {through, F + F * a * through};
}

}  // namespace insitu
