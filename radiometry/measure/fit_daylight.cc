// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_daylight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "radiometry/measure/robust_weights.h"
#include "radiometry/spectrum/color.h"

namespace insitu {
namespace {

constexpr double kRankDefect = 1e16;  // condition reported then
constexpr double kRankTolerance = 1e-8;
// Sigmas from where a photographed sky counts less. Nearer it is the samples that give way: it is
// seen as it is, while what stands around them may be no polygon. Chosen on three sites whose sky
// is known.
constexpr double kFarOff = 5;

// The ambient column of Eq. (9): pi as in Eq. (4); none where the surroundings are known.
double AmbientFactor(const DaylightSample& sample) {
  return sample.surroundings ? 0 : sample.geometry.ambient;
}

// What a sample shows that sun, ambient light and sky have to explain.
double Unexplained(const DaylightSample& sample, double brdf, int bin) {
  return sample.true_color[bin] - (sample.surroundings ? brdf * (*sample.surroundings)[bin] : 0);
}

// One bin's weighted equations A x = y for x = (sun, ambient, sky).
struct Equations {
  Eigen::MatrixX3d A;
  Eigen::VectorXd y;
};

struct Solution {
  Eigen::Vector3d radiance = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();
  double condition = 1;
};

// The photographed sky in a system of samples; its sigma is in units of their sigma.
struct WeighedSky {
  Spectrum radiance, sigma;
  double weight = 1;
};

// What the equations are made of.
struct DaylightObservations {
  const std::vector<DaylightSample>& samples;
  const Spectrum& brdf;
  bool has_sun = false;
  const SpectralBins& bins;
  std::vector<double> weights;  // of the samples
  std::optional<WeighedSky> sky = {};
  bool is_bounded = true;  // no component below zero
};

Equations SetUp(const DaylightObservations& observed, int bin) {
  const std::vector<DaylightSample>& samples = observed.samples;
  const double brdf = observed.brdf[bin];
  const int n = static_cast<int>(samples.size()), rows = n + (observed.sky ? 1 : 0);
  Equations equations{Eigen::MatrixX3d(rows, 3), Eigen::VectorXd(rows)};
  for (int i = 0; i < n; ++i) {
    const LightGeometry& seen = samples[i].geometry;
    const double p = std::sqrt(observed.weights[i]) / samples[i].sigma[bin];
    equations.A.row(i) << (observed.has_sun ? seen.sun : 0), AmbientFactor(samples[i]),
        seen.sky * samples[i].relative_sky[bin];
    equations.A.row(i) *= p * brdf;
    equations.y[i] = p * Unexplained(samples[i], brdf, bin);
  }
  if (const auto& sky = observed.sky) {
    const double p = std::sqrt(sky->weight) / sky->sigma[bin];
    equations.A.row(n) << 0, 0, p;
    equations.y[n] = p * sky->radiance[bin];
  }
  return equations;
}

std::vector<int> InfluentialColumns(const Eigen::MatrixX3d& A) {
  std::vector<int> columns;
  for (int c = 0; c < 3; ++c) {
    if (A.col(c).norm() > 0) columns.push_back(c);
  }
  return columns;
}

// Columns of unit length, so that rank and condition mean the geometry, not the units.
Eigen::MatrixXd ScaledColumns(const Eigen::MatrixX3d& A, const std::vector<int>& columns) {
  Eigen::MatrixXd scaled(A.rows(), columns.size());
  for (size_t i = 0; i < columns.size(); ++i) scaled.col(i) = A.col(columns[i]).normalized();
  return scaled;
}

std::vector<int> Subset(const std::vector<int>& columns, unsigned mask) {
  std::vector<int> subset;
  for (size_t i = 0; i < columns.size(); ++i) {
    if (mask >> i & 1) subset.push_back(columns[i]);
  }
  return subset;
}

// Least squares, whatever the sign, of some columns alone, which need not be independent.
struct Unbounded {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  bool is_unique = false;
};
Unbounded SolveUnbounded(const Equations& equations, const std::vector<int>& columns) {
  const LeastSquaresSolution scaled =
      SolveLeastSquares(ScaledColumns(equations.A, columns), equations.y, kRankTolerance);
  Unbounded solution;
  solution.is_unique = scaled.rank == static_cast<int>(columns.size());
  for (size_t i = 0; i < columns.size(); ++i) {
    const double scale = equations.A.col(columns[i]).norm();
    solution.x[columns[i]] = scaled.x(static_cast<Eigen::Index>(i)) / scale;
  }
  return solution;
}

// Exact non-negative least squares: its solution is the least-squares solution on its own support,
// so with three unknowns all supports can be tried.
Eigen::Vector3d SolveNonNegative(const Equations& equations, const std::vector<int>& columns) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double smallest = equations.y.squaredNorm();
  for (unsigned mask = 1; mask < 1u << columns.size(); ++mask) {
    const std::vector<int> support = Subset(columns, mask);
    const auto [x, is_unique] = SolveUnbounded(equations, support);
    if (!is_unique || x.minCoeff() < 0) continue;
    const double cost = (equations.A * x - equations.y).squaredNorm();
    if (cost >= smallest) continue;
    smallest = cost;
    best = x;
  }
  return best;
}

// Standard deviations of all influential components, those held at zero included, from the
// pseudo-inverse of the unconstrained system, scaled by the variance of the residuals.
void SetPrecision(const Equations& equations, const std::vector<int>& columns, Solution* solution) {
  const auto [singular, right] = SingularValuesOf(ScaledColumns(equations.A, columns));
  const double smallest = singular[singular.size() - 1];
  solution->condition = smallest > 0 ? std::min(kRankDefect, singular[0] / smallest) : kRankDefect;
  const double dof = static_cast<double>(equations.y.size()) - static_cast<double>(columns.size());
  const double squares = (equations.A * solution->radiance - equations.y).squaredNorm();
  const double variance_factor = dof > 0 ? std::max(1.0, squares / dof) : 1.0;
  for (size_t i = 0; i < columns.size(); ++i) {
    double variance = 0;
    for (int k = 0; k < singular.size(); ++k) {
      if (singular[k] < kRankTolerance * singular[0]) continue;
      variance += std::pow(right(static_cast<Eigen::Index>(i), k) / singular[k], 2);
    }
    solution->sigma[columns[i]] =
        std::sqrt(variance * variance_factor) / equations.A.col(columns[i]).norm();
  }
}

Solution Solve(const Equations& equations, bool is_bounded) {
  Solution solution;
  const std::vector<int> columns = InfluentialColumns(equations.A);
  if (columns.empty()) return solution;
  solution.radiance =
      is_bounded ? SolveNonNegative(equations, columns) : SolveUnbounded(equations, columns).x;
  SetPrecision(equations, columns, &solution);
  return solution;
}

// The three components and their sigmas.
std::array<Spectrum*, 6> PartsOf(DaylightFit* fit) {
  return {&fit->sun_radiance, &fit->ambient_radiance, &fit->sky_radiance,
          &fit->sun_sigma,    &fit->ambient_sigma,    &fit->sky_sigma};
}

DaylightFit SolveBins(const DaylightObservations& observed) {
  DaylightFit fit;
  for (Spectrum* part : PartsOf(&fit)) part->setZero();
  for (int bin = 0; bin < observed.bins.count; ++bin) {
    const Solution x = Solve(SetUp(observed, bin), observed.is_bounded);
    fit.sun_radiance[bin] = x.radiance[0];
    fit.ambient_radiance[bin] = x.radiance[1];
    fit.sky_radiance[bin] = x.radiance[2];
    fit.sun_sigma[bin] = x.sigma[0];
    fit.ambient_sigma[bin] = x.sigma[1];
    fit.sky_sigma[bin] = x.sigma[2];
    fit.condition = std::max(fit.condition, x.condition);
  }
  return fit;
}

// The paper's k, one for all wavelengths, times its L, which is D65 as in §7 unless another is
// given. The mean over the spectrum is weighted by what the eye makes of L, so that the luminance
// stays as measured.
Spectrum AverageOverWavelength(const Spectrum& radiance, const Spectrum& relative_spectrum,
                               const SpectralBins& bins) {
  return relative_spectrum *
         (Tristimulus(radiance, bins).y() / Tristimulus(relative_spectrum, bins).y());
}

// As printed: the plain mean of k over the bins. [Durisch92, §4.3]
Spectrum PlainMeanOverWavelength(const Spectrum& radiance, const Spectrum& relative_spectrum,
                                 const SpectralBins& bins) {
  return relative_spectrum *
         (radiance.head(bins.count) / relative_spectrum.head(bins.count)).mean();
}

Spectrum ModelRadiance(const DaylightFit& fit, const Spectrum& brdf, const DaylightSample& sample) {
  const Spectrum ambient = sample.surroundings
                               ? *sample.surroundings
                               : Spectrum(fit.ambient_radiance * sample.geometry.ambient);
  return brdf * (fit.sun_radiance * sample.geometry.sun + ambient +
                 fit.sky_radiance * sample.geometry.sky * sample.relative_sky);
}

// Per sample: root mean square over the bins, in units of sigma.
std::vector<double> ResidualMagnitudes(const std::vector<DaylightSample>& samples,
                                       const DaylightFit& fit, const Spectrum& brdf,
                                       const SpectralBins& bins) {
  std::vector<double> magnitudes;
  for (const DaylightSample& sample : samples) {
    const Spectrum residual = (sample.true_color - ModelRadiance(fit, brdf, sample)) / sample.sigma;
    magnitudes.push_back(std::sqrt(residual.head(bins.count).square().mean()));
  }
  return magnitudes;
}

void SetResiduals(const std::vector<DaylightSample>& samples, const Spectrum& brdf,
                  const SpectralBins& bins, DaylightFit* fit) {
  const std::vector<double> magnitudes = ResidualMagnitudes(samples, *fit, brdf, bins);
  fit->rms = Eigen::VectorXd::Map(magnitudes.data(), magnitudes.size()).norm() /
             std::sqrt(static_cast<double>(magnitudes.size()));
  fit->over_sigma = magnitudes;
  for (const DaylightSample& sample : samples) {
    const Spectrum model = ModelRadiance(*fit, brdf, sample);
    const double measured = sample.true_color.head(bins.count).mean();
    fit->residuals.push_back((measured - model.head(bins.count).mean()) /
                             std::max(std::abs(measured), sample.sigma.head(bins.count).mean()));
  }
}

// To the terms of Eqs. (4) and (5): see the header.
void SpreadSurroundings(const std::vector<DaylightSample>& samples, DaylightFit* fit) {
  Spectrum irradiance = Spectrum::Zero();
  double hidden = 0;  // projected solid angle that the sky does not fill [sr]
  for (const DaylightSample& sample : samples) {
    irradiance += *sample.surroundings;
    hidden += sample.geometry.ambient - sample.geometry.sky;
  }
  fit->ambient_radiance = (irradiance / std::max(hidden, 1e-9)).min(fit->sky_radiance);
  fit->sky_radiance -= fit->ambient_radiance;
}

// How large the residuals are, in sigma; at least 1.
double VarianceScale(const std::vector<double>& residuals, const std::vector<double>& weights,
                     int unknowns) {
  double squares = 0, count = 0;
  for (size_t i = 0; i < residuals.size(); ++i) {
    squares += weights[i] * residuals[i] * residuals[i];
    count += weights[i];
  }
  return std::sqrt(std::max(1.0, squares / std::max(1.0, count - unknowns)));
}

// Root mean square over the bins.
double SkyOverSigma(const DaylightFit& fit, const SkyObservation& sky, const SpectralBins& bins) {
  const Spectrum residual = (fit.sky_radiance - sky.radiance) / sky.sigma;
  return std::sqrt(residual.head(bins.count).square().mean());
}

// Robust: weights and solution take turns.
DaylightFit FitRobustly(DaylightObservations* observed) {
  observed->weights.assign(observed->samples.size(), 1.0);
  DaylightFit fit = SolveBins(*observed);
  for (int pass = 0; pass < kRobustPasses; ++pass) {
    observed->weights =
        HuberWeights(ResidualMagnitudes(observed->samples, fit, observed->brdf, observed->bins));
    fit = SolveBins(*observed);
  }
  return fit;
}

// `observed` as FitRobustly left it, and `fit` what it found without the sky.
DaylightFit FitWithSky(const SkyObservation& sky, DaylightFit fit, DaylightObservations* observed) {
  const auto magnitudes = [&] {
    return ResidualMagnitudes(observed->samples, fit, observed->brdf, observed->bins);
  };
  const double scale = VarianceScale(magnitudes(), observed->weights, observed->has_sun ? 2 : 1);
  observed->sky = WeighedSky{sky.radiance, sky.sigma / scale};
  for (int pass = 0; pass < kRobustPasses; ++pass) {
    fit = SolveBins(*observed);
    observed->weights = HuberWeights(magnitudes());
    observed->sky->weight =
        std::min(1.0, kFarOff / std::max(SkyOverSigma(fit, sky, observed->bins), 1e-300));
  }
  fit.sky_over_sigma = SkyOverSigma(fit, sky, observed->bins);
  return fit;
}

// [Durisch92, §4.3] to the letter.
DaylightFit FitAsPrinted(const std::vector<DaylightSample>& samples, const Spectrum& brdf,
                         bool has_sun, const SpectralBins& bins, const Spectrum& relative) {
  const std::vector<DaylightSample> alike = AlikeInSigma(samples);
  DaylightObservations observed{alike, brdf, has_sun, bins, {}, {}, false};
  observed.weights.assign(alike.size(), 1.0);
  DaylightFit fit = SolveBins(observed);
  SetResiduals(alike, brdf, bins, &fit);
  for (Spectrum* part : PartsOf(&fit)) *part = PlainMeanOverWavelength(*part, relative, bins);
  return fit;
}

bool HaveSurroundings(const std::vector<DaylightSample>& samples) {
  const auto with = std::count_if(samples.begin(), samples.end(),
                                  [](const auto& sample) { return sample.surroundings; });
  INSITU_CHECK(with == 0 || with == static_cast<long>(samples.size()));
  return with > 0;
}

}  // namespace

DaylightFit FitDaylight(const std::vector<DaylightSample>& samples, const Spectrum& brdf,
                        bool has_sun, const SpectralBins& bins, const DaylightFitOptions& options) {
  INSITU_CHECK(samples.size() >= (has_sun ? 3u : 2u));
  INSITU_CHECK((brdf.head(bins.count) > 0).all());
  for (const DaylightSample& sample : samples) {
    INSITU_CHECK((sample.sigma.head(bins.count) > 0).all());
  }
  const bool has_surroundings = HaveSurroundings(samples);
  const Spectrum relative = options.relative_spectrum.value_or(IlluminantD65(bins));
  if (options.as_printed) {
    INSITU_CHECK(!has_surroundings);
    return FitAsPrinted(samples, brdf, has_sun, bins, relative);
  }
  DaylightObservations observed{samples, brdf, has_sun, bins, {}, {}};
  DaylightFit fit = FitRobustly(&observed);
  if (has_surroundings && options.sky) fit = FitWithSky(*options.sky, fit, &observed);
  SetResiduals(samples, brdf, bins, &fit);
  if (has_surroundings) SpreadSurroundings(samples, &fit);
  if (options.average_over_wavelength) {
    for (Spectrum* part : PartsOf(&fit)) *part = AverageOverWavelength(*part, relative, bins);
  }
  return fit;
}

}  // namespace insitu
