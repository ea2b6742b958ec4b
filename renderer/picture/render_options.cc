// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/picture/render_options.h"

#include "calibration/files/error.h"

namespace insitu {

void RenderOptions::Check() const {
  INSITU_CHECK(fewest_rays >= 4 && fewest_rays % 4 == 0);
  INSITU_CHECK(most_rays >= fewest_rays && most_rays % 4 == 0);
  INSITU_CHECK(tolerance > 0);
  INSITU_CHECK(reach >= 0);
  INSITU_CHECK(block == 1 || block == 2 || block == 4);
  INSITU_CHECK(threads >= 0);
  INSITU_CHECK(outline_rays >= most_rays && outline_rays % 4 == 0);
  INSITU_CHECK(!point_spread || (point_spread->center_sigma > 0 && point_spread->corner_sigma > 0));
}

}  // namespace insitu
