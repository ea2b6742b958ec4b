// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of a photo's lens besides its intrinsics.
#pragma once

#include <Eigen/Core>
#include <string>

namespace insitu {

struct PhotoLens {
  std::string camera = "camera";  // photos of one camera share their lens
  Eigen::MatrixXd covariance;     // of its intrinsics, from its calibration; empty: exact
};

}  // namespace insitu
