// SPDX-License-Identifier: GPL-3.0-or-later
// Weights for samples that contradict the others: a shadow nobody modelled, a stain, a reflection.
#pragma once

#include <vector>

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// Standard deviations per median of magnitudes of a normal distribution.
inline constexpr double kSigmaOverMedian = 1.4826;

// The middle value, the upper one of two; 0 of none.
double Median(std::vector<double> values);

// Times that weights and fit take turns.
inline constexpr int kRobustPasses = 20;

// Weights in (0, 1] by Huber's function of residual magnitudes (>= 0, in units of their sigma);
// 1 up to 1.345 robust standard deviations, which are taken as at least one sigma.
// [Huber 1964; tuning constant for 95 % efficiency on normal errors]
std::vector<double> HuberWeights(const std::vector<double>& residuals);

// Samples with a `sigma` by bin, all of the same: the root mean square of theirs. For least squares
// without weights, as the paper prints them.
template <typename Sample>
std::vector<Sample> AlikeInSigma(std::vector<Sample> samples) {
  Spectrum variance = Spectrum::Zero();
  for (const Sample& sample : samples) variance += sample.sigma.square();
  for (Sample& sample : samples) {
    sample.sigma = (variance / static_cast<double>(samples.size())).sqrt();
  }
  return samples;
}

}  // namespace insitu
