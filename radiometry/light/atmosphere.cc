// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/atmosphere.h"

#include "calibration/files/error.h"

namespace insitu {

Spectrum TransmittanceOver(const Atmosphere& air, double distance) {
  INSITU_CHECK(distance >= 0);
  return (distance * air.transmittance.log()).exp();  // of whole packets, unlike pow
}

Spectrum ApparentColor(const Spectrum& true_color, const Atmosphere& air, double distance) {
  const Spectrum tau_d = TransmittanceOver(air, distance);
  return true_color * tau_d + air.horizon * (1 - tau_d);
}

Spectrum TrueColor(const Spectrum& apparent_color, const Atmosphere& air, double distance) {
  return (apparent_color - air.horizon) / TransmittanceOver(air, distance) + air.horizon;
}

}  // namespace insitu
