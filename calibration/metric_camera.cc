// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/metric_camera.h"

namespace insitu {

const std::vector<std::string>& ParameterNames(MetricModel model) {
  static const std::vector<std::string> kBrown = {"c",  "xp", "yp", "K1",     "K2",
                                                  "K3", "P1", "P2", "aspect", "skew"};
  static const std::vector<std::string> kBalanced = {"c",  "xh", "yh", "A1", "A2",
                                                     "A3", "B1", "B2", "C1", "C2"};
  return model == MetricModel::kBackwardBrown ? kBrown : kBalanced;
}

}  // namespace insitu
