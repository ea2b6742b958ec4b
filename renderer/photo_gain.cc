// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/photo_gain.h"

#include <algorithm>

#include "calibration/files/error.h"

namespace insitu {

Grain GrainInUnit(const Grain& grain, const Eigen::Vector3d& gain) {
  Grain in_unit = grain;
  in_unit.floor = grain.floor.cwiseQuotient(gain.cwiseAbs2());
  in_unit.slope = grain.slope.cwiseQuotient(gain);
  return in_unit;
}

void BackToPhotograph(const Raster& photo, const Raster& in_unit, const Eigen::Vector3d& gain,
                      Raster* result) {
  INSITU_CHECK(photo.data.size() == result->data.size());
  INSITU_CHECK(in_unit.data.size() == result->data.size());
  const Eigen::Vector3f factor = gain.cast<float>();
  for (size_t i = 0; i + 2 < result->data.size(); i += 3) {
    float* pixel = &result->data[i];
    if (std::equal(pixel, pixel + 3, &in_unit.data[i])) {
      std::copy_n(&photo.data[i], 3, pixel);
    } else {
      for (int c = 0; c < 3; ++c) pixel[c] *= factor[c];
    }
  }
}

}  // namespace insitu
