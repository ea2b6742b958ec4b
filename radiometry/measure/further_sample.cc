// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/further_sample.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiometry/measure/robust_weights.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSingularNormals = 1e-12;  // determinant over the diagonal's product
constexpr int kDistances = 40;

// Normal equations of two unknowns.
struct Normals {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();

  void Add(double a, double b, double sigma) {
    const Eigen::Vector2d row = Eigen::Vector2d(a, b) / sigma;
    matrix += row * row.transpose();
  }
  // Standard deviations; nullopt: they cannot be told apart.
  std::optional<Eigen::Vector2d> Sigma() const {
    const double product = matrix(0, 0) * matrix(1, 1);
    if (!(product > 0) || matrix.determinant() < kSingularNormals * product) return std::nullopt;
    return Eigen::Vector2d(matrix.inverse().diagonal().cwiseSqrt());
  }
};

// The bin about 555 nm stands for all.
int MiddleBin(const SpectralBins& bins) {
  return static_cast<int>((555 - kFirstWavelength) / bins.Width());
}

double MedianRelativeSigma(const std::vector<DaylightSample>& samples, int bin) {
  std::vector<double> relative;
  for (const DaylightSample& sample : samples) {
    relative.push_back(sample.sigma[bin] / std::max(sample.true_color[bin], sample.sigma[bin]));
  }
  return Median(relative);
}

struct Candidate {
  Sentence where;
  double sun, sky;  // [sr]
};

std::vector<Candidate> Candidates(bool has_sun) {
  std::vector<Candidate> candidates = {
      {Sentence("inOpenShade", "in open shade, facing much of the sky"), 0, 0.8 * kPi},
      {Sentence("inDeepShade", "in deep shade, facing little of the sky"), 0, 0.15 * kPi}};
  if (has_sun) {
    candidates.push_back(
        {Sentence("inFullSun", "in full sun, facing it"), kSolarSolidAngle, 0.6 * kPi});
  }
  return candidates;
}

}  // namespace

std::optional<FurtherDaylightSample> BestFurtherSample(const std::vector<DaylightSample>& samples,
                                                       const DaylightFit& fit, const Spectrum& brdf,
                                                       bool has_sun, const SpectralBins& bins) {
  if (samples.empty()) return std::nullopt;
  const int bin = MiddleBin(bins);
  const double sky_radiance = fit.sky_radiance[bin] + fit.ambient_radiance[bin];
  const double sun_radiance = fit.sun_radiance[bin];
  Normals now;
  for (const DaylightSample& sample : samples) {
    now.Add(brdf[bin] * (has_sun ? sample.geometry.sun : 0), brdf[bin] * sample.geometry.sky,
            sample.sigma[bin]);
  }
  const auto sigma = now.Sigma();
  if (!sigma || !(sky_radiance > 0)) return std::nullopt;
  const double relative = MedianRelativeSigma(samples, bin);
  std::optional<FurtherDaylightSample> best;
  double least = kWorthASample;
  for (const Candidate& candidate : Candidates(has_sun)) {
    const double radiance =
        brdf[bin] * (sun_radiance * candidate.sun + sky_radiance * candidate.sky);
    Normals then = now;
    then.Add(brdf[bin] * candidate.sun, brdf[bin] * candidate.sky, relative * radiance);
    const Eigen::Vector2d left = then.Sigma()->cwiseQuotient(*sigma);
    if (left.minCoeff() >= least) continue;
    least = left.minCoeff();
    best = FurtherDaylightSample{candidate.where, left[0], left[1]};
  }
  return best;
}

std::optional<FurtherHazeSample> BestFurtherSample(const std::vector<HazeSample>& samples,
                                                   const AtmosphereFit& fit,
                                                   const SpectralBins& bins) {
  if (samples.size() < 2) return std::nullopt;
  const int bin = MiddleBin(bins);
  const double extinction = -std::log(fit.air.transmittance[bin]);
  const double contrast = fit.true_color[bin] - fit.air.horizon[bin];
  std::vector<double> sigmas;
  double farthest = 0;
  Normals now;
  const auto add = [&](double distance, double sigma, Normals* normals) {
    const double left = std::exp(-extinction * distance);
    normals->Add(left, -contrast * distance * left, sigma);
  };
  for (const HazeSample& sample : samples) {
    add(sample.distance, sample.sigma[bin], &now);
    sigmas.push_back(sample.sigma[bin]);
    farthest = std::max(farthest, sample.distance);
  }
  const auto sigma = now.Sigma();
  if (!sigma) return std::nullopt;
  std::optional<FurtherHazeSample> best;
  double least = kWorthASample;
  for (int i = 1; i <= kDistances; ++i) {
    const double distance = 2 * farthest * i / kDistances;
    Normals then = now;
    add(distance, Median(sigmas), &then);
    const double left = (*then.Sigma())[1] / (*sigma)[1];
    if (left >= least) continue;
    least = left;
    best = FurtherHazeSample{distance, left};
  }
  return best;
}

}  // namespace insitu
