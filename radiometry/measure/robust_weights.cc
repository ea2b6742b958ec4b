// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/robust_weights.h"

#include <algorithm>

namespace insitu {

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> HuberWeights(const std::vector<double>& residuals) {
  const double scale = std::max(1.0, kSigmaOverMedian * Median(residuals));
  std::vector<double> weights;
  for (const double residual : residuals) {
    weights.push_back(std::min(1.0, 1.345 * scale / std::max(residual, 1e-300)));
  }
  return weights;
}

}  // namespace insitu
