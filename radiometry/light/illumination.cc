// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/illumination.h"

#include <cmath>

#include "calibration/files/error.h"

namespace insitu {

Spectrum ReflectedRadiance(double diffuse_weight, const Spectrum& brdf,
                           const Spectrum& irradiance) {
  return diffuse_weight * brdf * irradiance;
}

Spectrum DiffuseBrdf(const Spectrum& true_color, double diffuse_weight,
                     const Spectrum& irradiance) {
  INSITU_CHECK(diffuse_weight > 0);
  return (irradiance > 0).select(true_color / (diffuse_weight * irradiance), 0.0);
}

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

}  // namespace insitu
