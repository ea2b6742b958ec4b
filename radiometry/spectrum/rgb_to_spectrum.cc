// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/rgb_to_spectrum.h"

#include <Eigen/LU>
#include <limits>

#include "calibration/files/error.h"

namespace insitu {
namespace {

// Tristimulus values of the indicators of the three domains; columns.
Eigen::Matrix3d DomainTristimulus(const PiecewiseBasis& domains, const SpectralBins& bins) {
  Eigen::Matrix3d xyz;
  xyz << Tristimulus(DomainIndicator(0, domains.second), bins),
      Tristimulus(DomainIndicator(domains.second, domains.third), bins),
      Tristimulus(DomainIndicator(domains.third, bins.count), bins);
  return xyz;
}

// The exact weights for given domains; nullopt if one is negative.
std::optional<Eigen::Vector3d> ExactWeights(const Eigen::Matrix3d& domain_xyz,
                                            const Eigen::Vector3d& tristimulus) {
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(domain_xyz);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector3d weights = solver.solve(tristimulus);
  if (weights.minCoeff() < 0) return std::nullopt;
  return weights;
}

template <typename Visit>
void ForEachPairOfTransitions(const SpectralBins& bins, Visit visit) {
  for (int second = 1; second < bins.count - 1; ++second) {
    for (int third = second + 1; third < bins.count; ++third) visit(second, third);
  }
}

}  // namespace

Spectrum DomainIndicator(int first_bin, int end_bin) {
  INSITU_CHECK(0 <= first_bin && first_bin <= end_bin && end_bin <= kMaxBins);
  Spectrum indicator = Spectrum::Zero();
  indicator.segment(first_bin, end_bin - first_bin) = 1;
  return indicator;
}

Spectrum Evaluate(const PiecewiseBasis& basis, const SpectralBins& bins) {
  return basis.weights[0] * DomainIndicator(0, basis.second) +
         basis.weights[1] * DomainIndicator(basis.second, basis.third) +
         basis.weights[2] * DomainIndicator(basis.third, bins.count);
}

std::optional<PiecewiseBasis> FindExactBasis(const Eigen::Vector3d& tristimulus,
                                             const SpectralBins& bins) {
  std::optional<PiecewiseBasis> best;
  ForEachPairOfTransitions(bins, [&](int second, int third) {
    PiecewiseBasis candidate{second, third, Eigen::Vector3d::Zero(), true};
    const auto weights = ExactWeights(DomainTristimulus(candidate, bins), tristimulus);
    if (!weights) return;
    candidate.weights = *weights;
    if (!best || weights->maxCoeff() < best->weights.maxCoeff()) best = candidate;
  });
  return best;
}

PiecewiseBasis FindNearestBox(const Eigen::Vector3d& tristimulus, const SpectralBins& bins) {
  PiecewiseBasis best;
  double smallest = std::numeric_limits<double>::infinity();
  ForEachPairOfTransitions(bins, [&](int second, int third) {
    PiecewiseBasis candidate{second, third, Eigen::Vector3d::Zero(), false};
    const Eigen::Matrix3d xyz = DomainTristimulus(candidate, bins);
    for (const Eigen::Vector3d& shape : {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 0, 1)}) {
      candidate.weights = shape * (tristimulus.y() / (xyz * shape).y());
      const double distance = (xyz * candidate.weights - tristimulus).norm();
      if (distance >= smallest) continue;
      smallest = distance;
      best = candidate;
    }
  });
  return best;
}

PiecewiseBasis FindBasis(const Eigen::Vector3d& tristimulus, const SpectralBins& bins) {
  const auto exact = FindExactBasis(tristimulus, bins);
  return exact ? *exact : FindNearestBox(tristimulus, bins);
}

namespace {

// Columns blue, green, red.
Eigen::Matrix<double, kMaxBins, 3> BasisOf(const RgbPrimaries& primaries,
                                           const SpectralBins& bins) {
  const Eigen::Matrix3d primary_xyz = RgbFromXyz(primaries).inverse();  // columns red, green, blue
  Eigen::Matrix<double, kMaxBins, 3> basis;
  for (int i = 0; i < 3; ++i) {
    basis.col(i) = Evaluate(FindBasis(primary_xyz.col(2 - i), bins), bins).matrix();
  }
  return basis;
}

}  // namespace

SpectralBasis::SpectralBasis(const RgbPrimaries& primaries, const SpectralBins& bins)
    : SpectralBasis(primaries, bins, primaries) {}

SpectralBasis::SpectralBasis(const RgbPrimaries& primaries, const SpectralBins& bins,
                             const RgbPrimaries& basis_primaries)
    : bins_(bins), basis_primaries_(basis_primaries), basis_(BasisOf(basis_primaries, bins)) {
  const Eigen::Matrix3d rgb_from_xyz = RgbFromXyz(primaries);
  const Eigen::Matrix<double, 3, kMaxBins> matching = ColorMatching(bins);
  rgb_from_spectrum_ = rgb_from_xyz * matching / matching.row(1).sum();
  luminance_from_rgb_ = rgb_from_xyz.inverse().row(1);
  const Eigen::Matrix3d W = rgb_from_spectrum_ * basis_;
  weights_from_rgb_ = W.fullPivLu().inverse();
  spectrum_from_rgb_ = basis_ * weights_from_rgb_;
  const Eigen::Matrix<double, kMaxBins, 3> own = BasisOf(primaries, bins);
  const Eigen::Matrix3d own_W = rgb_from_spectrum_ * own;
  own_from_rgb_ = own * own_W.fullPivLu().inverse();
  white_ = (own_from_rgb_ * Eigen::Vector3d::Ones()).array();
}

Spectrum SpectralBasis::Ones() const { return DomainIndicator(0, bins_.count); }

Spectrum SpectralBasis::SpectrumFromRgb(const Eigen::Vector3d& rgb) const {
  return (spectrum_from_rgb_ * rgb).array();
}

Eigen::Vector3d SpectralBasis::RgbFromSpectrum(const Spectrum& stimulus) const {
  return rgb_from_spectrum_ * stimulus.matrix();
}

Spectrum SpectralBasis::ReflectanceFromRgb(const Eigen::Vector3d& rgb) const {
  const double luminance = luminance_from_rgb_ * rgb;
  return Ones() * (white_ > 0).select((own_from_rgb_ * rgb).array() / white_, luminance);
}

}  // namespace insitu
