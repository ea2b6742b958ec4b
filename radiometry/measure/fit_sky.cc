// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_sky.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "calibration/algebra/decompositions.h"
#include "radiometry/measure/robust_weights.h"

namespace insitu {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSkyCell = 5 * kDegree;
constexpr double kSunCosine = 0.985;    // of ten degrees
constexpr double kSigmaOfLog = 0.01;    // of ln radiance, at least: cameras and lenses differ
constexpr double kSigmaOfLevel = 0.03;  // of ln of the level, at least: neither is a sky smooth
constexpr double kGrossOutlier = 5;     // robust standard deviations
constexpr size_t kFewestCells = 6;
constexpr double kSurely = 3, kLeastEffect = 0.03, kVague = 0.3;
constexpr double kLeastGradation = -1.7, kMostGradation = 1.1, kMostGlow = 1.5;

enum Term { kLevel, kGradation, kGlow };

// One cell of the sky.
struct LogRow {
  std::array<double, 3> terms;  // by Term
  Eigen::Array<double, kMaxBins, 1> log_radiance;
};

// The median of each channel over places that lie together.
std::vector<SkyPlace> MediansOfCells(const std::vector<SkyPlace>& places,
                                     const Eigen::Vector3d& zenith) {
  const Eigen::Vector3d x = zenith.unitOrthogonal(), y = zenith.cross(x);
  std::map<std::pair<int, int>, std::vector<const SkyPlace*>> cells;
  for (const SkyPlace& place : places) {
    const double height = std::asin(std::clamp(zenith.dot(place.direction), -1.0, 1.0));
    const double turn = std::atan2(y.dot(place.direction), x.dot(place.direction));
    const int band = static_cast<int>(std::floor(height / kSkyCell));
    const double width = kSkyCell / std::max(0.05, std::cos((band + 0.5) * kSkyCell));
    cells[{band, static_cast<int>(std::floor(turn / width))}].push_back(&place);
  }
  std::vector<SkyPlace> medians;
  for (const auto& [key, cell] : cells) {
    SkyPlace median{Eigen::Vector3d::Zero(), {}};
    for (const SkyPlace* place : cell) median.direction += place->direction;
    median.direction.normalize();
    for (int c = 0; c < 3; ++c) {
      std::vector<double> values;
      for (const SkyPlace* place : cell) values.push_back(place->rgb[c]);
      median.rgb[c] = Median(std::move(values));
    }
    medians.push_back(median);
  }
  return medians;
}

std::vector<LogRow> LogRows(const std::vector<SkyPlace>& cells, const Eigen::Vector3d& zenith,
                            const std::optional<Eigen::Vector3d>& sun,
                            const SpectralBasis& spectra) {
  std::vector<LogRow> rows;
  for (const SkyPlace& cell : cells) {
    const Spectrum radiance = spectra.SpectrumFromRgb(cell.rgb);
    if (!(radiance.head(spectra.bins().count) > 0).all()) continue;  // beyond Rec. 709
    LogRow row{{1, SkyGradation(zenith.dot(cell.direction)), 0}, Spectrum::Zero()};
    if (sun) row.terms[kGlow] = SkyGlow(sun->dot(cell.direction));
    row.log_radiance.head(spectra.bins().count) = radiance.head(spectra.bins().count).log();
    rows.push_back(row);
  }
  return rows;
}

// Least squares for some of the terms.
struct LogFit {
  std::array<Spectrum, 3> value, sigma;  // by Term; zero of those left out
  Spectrum variance = Spectrum::Zero();  // of unit weight
  double rms = 0;
  std::vector<double> residuals;  // of each row, over kSigmaOfLog, root mean square over the bins
};

LogFit SolveLog(const std::vector<LogRow>& rows, const std::vector<Term>& terms, int bins,
                const std::vector<double>& weights) {
  const auto n = static_cast<Eigen::Index>(rows.size()),
             k = static_cast<Eigen::Index>(terms.size());
  Eigen::MatrixXd A(n, k), Y(n, bins);
  Eigen::VectorXd w(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < k; ++j) A(i, j) = rows[i].terms[terms[j]];
    Y.row(i) = rows[i].log_radiance.head(bins).matrix().transpose();
    w[i] = weights[i];
  }
  const Eigen::MatrixXd cofactor = InverseOfSymmetric(A.transpose() * w.asDiagonal() * A);
  const Eigen::MatrixXd X = cofactor * (A.transpose() * w.asDiagonal() * Y), V = A * X - Y;
  LogFit fit;
  fit.value.fill(Spectrum::Zero());
  fit.sigma.fill(Spectrum::Zero());
  const double freedom = std::max(1.0, w.sum() - static_cast<double>(k));
  for (int bin = 0; bin < bins; ++bin) {
    const double variance =
        std::max(kSigmaOfLog * kSigmaOfLog, V.col(bin).cwiseAbs2().dot(w) / freedom);
    fit.variance[bin] = variance;
    for (Eigen::Index j = 0; j < k; ++j) {
      fit.value[terms[j]][bin] = X(j, bin);
      fit.sigma[terms[j]][bin] = std::sqrt(variance * cofactor(j, j));
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    fit.residuals.push_back(V.row(i).norm() / std::sqrt(bins) / kSigmaOfLog);
  }
  fit.rms = std::sqrt(V.cwiseAbs2().rowwise().mean().dot(w) / w.sum());
  return fit;
}

// Robust: what contradicts the rest counts less, and grossly, nothing.
LogFit FitTerms(const std::vector<LogRow>& rows, const std::vector<Term>& terms, int bins) {
  std::vector<double> weights(rows.size(), 1.0);
  LogFit fit = SolveLog(rows, terms, bins, weights);
  for (int pass = 0; pass < kRobustPasses; ++pass) {
    weights = HuberWeights(fit.residuals);
    fit = SolveLog(rows, terms, bins, weights);
  }
  const double scale = std::max(1.0, kSigmaOverMedian * Median(fit.residuals));
  for (size_t i = 0; i < rows.size(); ++i) {
    if (fit.residuals[i] > kGrossOutlier * scale) weights[i] = 0;
  }
  return SolveLog(rows, terms, bins, weights);
}

// Whether a term that was fitted is to be believed.
bool IsSupported(const LogFit& fit, Term term, const std::vector<LogRow>& rows, int bins) {
  const double value = fit.value[term].head(bins).mean(), sigma = fit.sigma[term].head(bins).mean();
  const auto [least, most] =
      std::ranges::minmax_element(rows, {}, [term](const LogRow& row) { return row.terms[term]; });
  const double effect = std::abs(value) * (most->terms[term] - least->terms[term]);
  return std::isfinite(value) && std::isfinite(sigma) && std::abs(value) > kSurely * sigma &&
         effect > kLeastEffect && sigma < kVague && (term != kGlow || value > 0);
}

// The richest of the shapes that is supported; of two equally rich ones, what fits better.
LogFit ChooseShape(const std::vector<LogRow>& rows, bool has_sun, int bins) {
  const LogFit uniform = FitTerms(rows, {kLevel}, bins);
  std::optional<LogFit> chosen;
  const auto consider = [&](const std::vector<Term>& terms) {
    const LogFit fit = FitTerms(rows, terms, bins);
    const bool is_supported = std::ranges::all_of(
        terms, [&](Term term) { return term == kLevel || IsSupported(fit, term, rows, bins); });
    if (is_supported && (!chosen || fit.rms < chosen->rms)) chosen = fit;
    return fit;
  };
  if (has_sun) consider({kLevel, kGradation, kGlow});
  if (chosen) return *chosen;
  const LogFit graded = consider({kLevel, kGradation});
  if (has_sun) consider({kLevel, kGlow});
  if (chosen) return *chosen;
  LogFit fit = uniform;
  fit.sigma[kGradation] = graded.sigma[kGradation];
  return fit;
}

// What the fifteen skies of the CIE have, and the level that belongs to it.
void KeepPlausible(const std::vector<LogRow>& rows, int bins, LogFit* fit) {
  Spectrum& gradation = fit->value[kGradation];
  Spectrum& glow = fit->value[kGlow];
  const Spectrum before_gradation = gradation, before_glow = glow;
  gradation = gradation.max(kLeastGradation).min(kMostGradation);
  glow = glow.max(0).min(kMostGlow);
  if ((gradation == before_gradation).all() && (glow == before_glow).all()) return;
  for (int bin = 0; bin < bins; ++bin) {
    std::vector<double> levels;
    for (const LogRow& row : rows) {
      levels.push_back(row.log_radiance[bin] - gradation[bin] * row.terms[kGradation] -
                       glow[bin] * row.terms[kGlow]);
    }
    fit->value[kLevel][bin] = Median(std::move(levels));
  }
}

// How ln of the level follows each term, ln radiance as it is: from two shapes beside the fitted
// one.
Spectrum LevelBy(Term term, const SkyShape& shape, const Eigen::Vector3d& zenith,
                 const Eigen::Vector3d& sun) {
  constexpr double kStep = 0.05;
  const auto log_scale = [&](double step) {
    SkyShape beside = shape;
    (term == kGradation ? beside.gradation : beside.glow) += step;
    return Spectrum(RelativeSky(beside, zenith, sun).scale().log());
  };
  return (log_scale(kStep) - log_scale(-kStep)) / (2 * kStep);
}

// Of ln of the level: both powers are taken for unknown, to within what the CIE's skies have,
// whichever were kept; a sky of another form than theirs misses a part of what they carry the level
// from what is seen; and what is about the fit, clouds, may be elsewhere, too.
Spectrum LevelSigma(const LogFit& fit, const std::vector<LogRow>& rows, const Spectrum& level,
                    const Eigen::Vector3d& zenith, const std::optional<Eigen::Vector3d>& sun,
                    int bins) {
  constexpr double kGradationOfSkies = 0.7, kGlowOfSkies = 0.5;  // standard deviations
  constexpr double kOfCarried = 1 / 3.0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Spectrum seen = Spectrum::Zero();
  for (const LogRow& row : rows) {
    seen += row.log_radiance / static_cast<double>(rows.size());
    const Eigen::Vector3d terms = Eigen::Map<const Eigen::Vector3d>(row.terms.data());
    normal += terms * terms.transpose();
  }
  const Eigen::Vector3d before(0, std::pow(kGradationOfSkies, -2), std::pow(kGlowOfSkies, -2));
  const SkyShape shape = {fit.value[kGradation], fit.value[kGlow]};
  const Spectrum by_gradation = LevelBy(kGradation, shape, zenith, sun.value_or(zenith));
  const Spectrum by_glow = sun ? LevelBy(kGlow, shape, zenith, *sun) : Spectrum(Spectrum::Zero());
  Spectrum sigma = Spectrum::Zero();
  for (int bin = 0; bin < bins; ++bin) {
    const Eigen::Vector3d a(1, by_gradation[bin], by_glow[bin]);
    Eigen::Matrix3d weights = normal / fit.variance[bin];
    weights.diagonal() += before;
    const double of_shape = a.dot(SolveSymmetric(weights, a));
    const double of_form = std::pow(kOfCarried * (std::log(level[bin]) - seen[bin]), 2);
    sigma[bin] = std::sqrt(std::pow(kSigmaOfLevel, 2) + std::pow(fit.rms, 2) + of_shape + of_form);
  }
  return sigma;
}

}  // namespace

SkyFit FitSky(const std::vector<SkyPlace>& places, const Eigen::Vector3d& zenith,
              const std::optional<Eigen::Vector3d>& sun, const SpectralBasis& spectra) {
  std::vector<SkyPlace> away_from_sun;
  std::ranges::copy_if(places, std::back_inserter(away_from_sun), [&](const SkyPlace& place) {
    return !sun || place.direction.dot(*sun) < kSunCosine;
  });
  const int bins = spectra.bins().count;
  const std::vector<SkyPlace> cells = MediansOfCells(away_from_sun, zenith);
  const std::vector<LogRow> rows = LogRows(cells, zenith, sun, spectra);
  SkyFit result;
  if (rows.empty()) return result;
  const auto [lowest, highest] = std::ranges::minmax(
      cells, {}, [&](const SkyPlace& cell) { return zenith.dot(cell.direction); });
  result.lowest = std::asin(zenith.dot(lowest.direction));
  result.highest = std::asin(zenith.dot(highest.direction));
  result.cells = static_cast<int>(rows.size());
  LogFit fit = rows.size() < kFewestCells ? FitTerms(rows, {kLevel}, bins)
                                          : ChooseShape(rows, sun.has_value(), bins);
  KeepPlausible(rows, bins, &fit);
  result.shape = {fit.value[kGradation], fit.value[kGlow]};
  result.sigma = {fit.sigma[kGradation], fit.sigma[kGlow]};
  result.rms = fit.rms;
  const RelativeSky sky(result.shape, zenith, sun.value_or(zenith));
  result.level = Spectrum::Zero();
  result.level->head(bins) = fit.value[kLevel].head(bins).exp() * sky.scale().head(bins);
  result.level_sigma = *result.level * LevelSigma(fit, rows, *result.level, zenith, sun, bins);
  return result;
}

}  // namespace insitu
