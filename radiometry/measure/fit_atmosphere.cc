// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_atmosphere.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "radiometry/measure/robust_weights.h"

namespace insitu {
namespace {

constexpr double kUnknown = 1;      // sigma of a transmittance that the samples leave open
constexpr double kSingular = 1e16;  // condition reported then

// With y = L - L_inf and tau = exp(-beta), Eq. (7) reads y = a exp(-beta d), a = L_0 - L_inf.
struct Exponential {
  double extinction = 0;  // beta [1/m]
  double contrast = 0;    // a
};

// One bin's observations.
struct Observations {
  Eigen::ArrayXd distance, contrast;
  Eigen::ArrayXd root_weight;  // 1 / sigma, times the root of the robust weight
  bool is_bounded = true;      // extinction >= 0
};

Eigen::ArrayXd Residuals(const Observations& seen, const Exponential& x) {
  return seen.root_weight * (seen.contrast - x.contrast * (-x.extinction * seen.distance).exp());
}

Eigen::MatrixX2d Jacobian(const Observations& seen, const Exponential& x) {
  const Eigen::ArrayXd e = seen.root_weight * (-x.extinction * seen.distance).exp();
  Eigen::MatrixX2d J(e.size(), 2);
  J.col(0) = -x.contrast * seen.distance * e;
  J.col(1) = e;
  return J;
}

// The best contrast at a given extinction.
double BestContrast(const Observations& seen, double extinction) {
  const Eigen::ArrayXd e = seen.root_weight * (-extinction * seen.distance).exp();
  return (e * seen.root_weight * seen.contrast).sum() / e.square().sum();
}

Exponential Step(const Observations& seen, const Exponential& x, double damping) {
  const Eigen::MatrixX2d J = Jacobian(seen, x);
  Eigen::Matrix2d N = J.transpose() * J;
  N.diagonal() *= 1 + damping;
  const Eigen::Vector2d step = SolveSymmetric(N, J.transpose() * Residuals(seen, x).matrix());
  const double extinction = x.extinction + step[0];
  if (seen.is_bounded && extinction <= 0) return {0, BestContrast(seen, 0)};
  return {extinction, x.contrast + step[1]};
}

// Gauss-Newton, damped where a full step would not improve (Levenberg, Marquardt).
Exponential FitExponential(const Observations& seen) {
  Eigen::Index nearest;
  seen.distance.minCoeff(&nearest);
  Exponential x{0, seen.contrast[nearest]};
  double cost = Residuals(seen, x).square().sum();
  for (double damping = 1e-4; damping < 1e12 && x.contrast != 0;) {
    const Exponential candidate = Step(seen, x, damping);
    const double candidate_cost = Residuals(seen, candidate).square().sum();
    if (candidate_cost < cost) {
      x = candidate;
      cost = candidate_cost;
      damping /= 10;
    } else {
      damping = std::max(10 * damping, 1e-12);
    }
  }
  return x;
}

Observations Observe(const std::vector<HazeSample>& samples, const Spectrum& horizon, int bin,
                     const std::vector<double>& weights, bool is_bounded) {
  const int n = static_cast<int>(samples.size());
  Observations seen{Eigen::ArrayXd(n), Eigen::ArrayXd(n), Eigen::ArrayXd(n), is_bounded};
  for (int i = 0; i < n; ++i) {
    seen.distance[i] = samples[i].distance;
    seen.contrast[i] = samples[i].apparent_color[bin] - horizon[bin];
    seen.root_weight[i] = std::sqrt(weights[i]) / samples[i].sigma[bin];
  }
  return seen;
}

void SetPrecision(const Observations& seen, const Exponential& x, int bin, AtmosphereFit* fit) {
  const Eigen::MatrixX2d J = Jacobian(seen, x);
  const Eigen::Matrix2d N = J.transpose() * J;
  const double correlation = N(0, 1) / std::sqrt(N(0, 0) * N(1, 1));
  if (N(0, 0) == 0 || 1 - std::abs(correlation) < 1 / kSingular) {
    fit->transmittance_sigma[bin] = kUnknown;
    fit->condition[bin] = kSingular;
    return;
  }
  fit->condition[bin] = (1 + std::abs(correlation)) / (1 - std::abs(correlation));
  const double dof = seen.distance.size() - 2;
  const double variance_factor =
      dof > 0 ? std::max(1.0, Residuals(seen, x).square().sum() / dof) : 1.0;
  const double sigma_extinction = std::sqrt(N.inverse()(0, 0) * variance_factor);
  fit->transmittance_sigma[bin] =
      std::min(kUnknown, sigma_extinction * fit->air.transmittance[bin]);
}

AtmosphereFit FitBins(const std::vector<HazeSample>& samples, const Spectrum& horizon,
                      const SpectralBins& bins, const std::vector<double>& weights,
                      bool is_bounded) {
  AtmosphereFit fit;
  fit.air.horizon = horizon;
  for (int bin = 0; bin < bins.count; ++bin) {
    const Observations seen = Observe(samples, horizon, bin, weights, is_bounded);
    const Exponential x = FitExponential(seen);
    fit.air.transmittance[bin] = std::exp(-x.extinction);
    fit.true_color[bin] = x.contrast + horizon[bin];
    SetPrecision(seen, x, bin, &fit);
  }
  return fit;
}

// Per sample: root mean square over the bins, in units of sigma.
std::vector<double> ResidualMagnitudes(const std::vector<HazeSample>& samples,
                                       const AtmosphereFit& fit, const SpectralBins& bins) {
  std::vector<double> magnitudes;
  for (const HazeSample& sample : samples) {
    const Spectrum model = ApparentColor(fit.true_color, fit.air, sample.distance);
    const Spectrum residual = (sample.apparent_color - model) / sample.sigma;
    magnitudes.push_back(std::sqrt(residual.head(bins.count).square().mean()));
  }
  return magnitudes;
}

void CheckSamples(const std::vector<HazeSample>& samples, const SpectralBins& bins) {
  INSITU_CHECK(samples.size() >= 2);
  double shortest = samples[0].distance, longest = samples[0].distance;
  for (const HazeSample& sample : samples) {
    INSITU_CHECK(sample.distance >= 0);
    INSITU_CHECK((sample.sigma.head(bins.count) > 0).all());
    shortest = std::min(shortest, sample.distance);
    longest = std::max(longest, sample.distance);
  }
  INSITU_CHECK(longest > shortest);
}

}  // namespace

AtmosphereFit FitAtmosphere(const std::vector<HazeSample>& given, const Spectrum& horizon,
                            const SpectralBins& bins, bool as_printed) {
  CheckSamples(given, bins);
  const std::vector<HazeSample> samples = as_printed ? AlikeInSigma(given) : given;
  AtmosphereFit fit =
      FitBins(samples, horizon, bins, std::vector<double>(samples.size(), 1.0), !as_printed);
  std::vector<double> magnitudes = ResidualMagnitudes(samples, fit, bins);
  for (int pass = 0; pass < (as_printed ? 0 : kRobustPasses); ++pass) {
    fit = FitBins(samples, horizon, bins, HuberWeights(magnitudes), true);
    magnitudes = ResidualMagnitudes(samples, fit, bins);
  }
  fit.rms = Eigen::VectorXd::Map(magnitudes.data(), magnitudes.size()).norm() /
            std::sqrt(static_cast<double>(magnitudes.size()));
  fit.over_sigma = magnitudes;
  for (const HazeSample& sample : samples) {
    const Spectrum model = ApparentColor(fit.true_color, fit.air, sample.distance);
    const double measured = sample.apparent_color.head(bins.count).mean();
    fit.residuals.push_back((measured - model.head(bins.count).mean()) /
                            std::max(std::abs(measured), sample.sigma.head(bins.count).mean()));
  }
  return fit;
}

}  // namespace insitu
