// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjustment_options.h"

#include <cmath>

#include "calibration/files/error.h"

namespace insitu {

void AdjustmentOptions::Check() const {
  INSITU_CHECK(plane_sigma > 0 && std::isfinite(plane_sigma));
  INSITU_CHECK(zenith_sigma > 0 && std::isfinite(zenith_sigma));
  INSITU_CHECK(sun_sigma > 0 && std::isfinite(sun_sigma));
  INSITU_CHECK(significance > 0 && significance < 1);
}

}  // namespace insitu
