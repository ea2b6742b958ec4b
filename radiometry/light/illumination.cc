// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/illumination.h"

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

}  // namespace insitu
