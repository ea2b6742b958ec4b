// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/similarity.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "reconstruction/geometry/resection.h"

namespace insitu {
namespace {

using Triple = std::array<size_t, 3>;

// Pairs about the centroids of both frames, so that large coordinates do not eat the digits.
struct CenteredPairs {
  Eigen::Vector3d source_origin, target_origin;
  std::vector<SimilarityPair> pairs;
};

CenteredPairs Centered(const std::vector<SimilarityPair>& pairs) {
  CenteredPairs centered{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), pairs};
  const auto count = static_cast<double>(pairs.size());
  for (const SimilarityPair& pair : pairs) {
    centered.source_origin += (pair.source - pairs[0].source) / count;
    centered.target_origin += (pair.target - pairs[0].target) / count;
  }
  centered.source_origin += pairs[0].source;
  centered.target_origin += pairs[0].target;
  for (SimilarityPair& pair : centered.pairs) {
    pair.source -= centered.source_origin;
    pair.target -= centered.target_origin;
  }
  return centered;
}

template <typename Indices>
bool IsSpread(const std::vector<SimilarityPair>& pairs, const Indices& indices) {
  std::vector<Eigen::Vector3d> sources, targets;
  for (const size_t i : indices) {
    sources.push_back(pairs[i].source);
    targets.push_back(pairs[i].target);
  }
  return !AreCollinear(sources, 0.01) && !AreCollinear(targets, 0.01);
}

// Unweighted and closed.
template <typename Indices>
std::optional<Similarity3> Umeyama(const std::vector<SimilarityPair>& pairs,
                                   const Indices& indices) {
  Eigen::Matrix3Xd sources(3, indices.size()), targets(3, indices.size());
  Eigen::Index column = 0;
  for (const size_t i : indices) {
    sources.col(column) = pairs[i].source;
    targets.col(column++) = pairs[i].target;
  }
  const Eigen::Matrix4d matrix = Eigen::umeyama(sources, targets, true);
  const double scale = std::cbrt(matrix.topLeftCorner<3, 3>().determinant());
  if (!matrix.allFinite() || !(scale > 0)) return std::nullopt;
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>() / scale;
  return Similarity3{scale, Eigen::Quaterniond(rotation).normalized(),
                     matrix.topRightCorner<3, 1>()};
}

std::vector<size_t> Inliers(const std::vector<SimilarityPair>& pairs, const Similarity3& fit,
                            double limit_sigma) {
  std::vector<size_t> inliers;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d residual = fit * pairs[i].source - pairs[i].target;
    if (residual.cwiseQuotient(pairs[i].sigma).cwiseAbs().maxCoeff() <= limit_sigma) {
      inliers.push_back(i);
    }
  }
  return inliers;
}

double WeightedSquares(const std::vector<SimilarityPair>& pairs, const std::vector<size_t>& indices,
                       const Similarity3& fit) {
  double sum = 0;
  for (const size_t i : indices) {
    sum += (fit * pairs[i].source - pairs[i].target).cwiseQuotient(pairs[i].sigma).squaredNorm();
  }
  return sum;
}

// All triples if they are few, else a sample that is the same on every run.
std::vector<Triple> Triples(size_t count, int max_trials) {
  std::vector<Triple> triples;
  if (count * (count - 1) * (count - 2) / 6 <= static_cast<size_t>(max_trials)) {
    for (size_t i = 0; i < count; ++i) {
      for (size_t j = i + 1; j < count; ++j) {
        for (size_t k = j + 1; k < count; ++k) triples.push_back({i, j, k});
      }
    }
    return triples;
  }
  std::mt19937 generator(1);  // its numbers are fixed by the standard, those of distributions not
  while (triples.size() < static_cast<size_t>(max_trials)) {
    const Triple triple = {generator() % count, generator() % count, generator() % count};
    if (triple[0] != triple[1] && triple[1] != triple[2] && triple[2] != triple[0]) {
      triples.push_back(triple);
    }
  }
  return triples;
}

struct NormalEquations {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(7, 7);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(7);
};

// d (s R x + t) = [-[s R x]x, I, s R x] (rotation increment, translation, relative scale)
NormalEquations Normal(const std::vector<SimilarityPair>& pairs, const std::vector<size_t>& indices,
                       const Similarity3& fit) {
  NormalEquations equations;
  for (const size_t i : indices) {
    const Eigen::Vector3d turned = fit.scale * (fit.rotation * pairs[i].source);
    Eigen::Matrix<double, 3, 7> jacobian;
    jacobian.leftCols<3>() << 0, turned.z(), -turned.y(), -turned.z(), 0, turned.x(), turned.y(),
        -turned.x(), 0;
    jacobian.middleCols<3>(3).setIdentity();
    jacobian.col(6) = turned;
    const Eigen::Vector3d weights = pairs[i].sigma.array().square().inverse();
    const Eigen::Vector3d misclosure = pairs[i].target - turned - fit.translation;
    const Eigen::Matrix<double, 7, 3> weighted = jacobian.transpose() * weights.asDiagonal();
    equations.normal += weighted * jacobian;
    equations.right += weighted * misclosure;
  }
  return equations;
}

Eigen::MatrixXd Cofactor(const NormalEquations& equations) {
  return InverseOfSymmetric(equations.normal);
}

Similarity3 LeastSquares(const std::vector<SimilarityPair>& pairs,
                         const std::vector<size_t>& indices, Similarity3 fit) {
  for (int iteration = 0; iteration < 50; ++iteration) {
    const NormalEquations equations = Normal(pairs, indices, fit);
    const Eigen::VectorXd step = SolveSymmetric(equations.normal, equations.right);
    const double angle = step.head<3>().norm();
    if (angle > 0) {
      fit.rotation = (Eigen::AngleAxisd(angle, step.head<3>() / angle) * fit.rotation).normalized();
    }
    fit.translation += step.segment<3>(3);
    fit.scale *= std::exp(step[6]);
    if (step.dot(equations.normal * step) < 1e-16) break;  // far below one sigma
  }
  return fit;
}

std::optional<std::vector<size_t>> Consensus(const std::vector<SimilarityPair>& pairs,
                                             const SimilarityOptions& options) {
  std::vector<size_t> best;
  double best_squares = 0;
  for (const Triple& triple : Triples(pairs.size(), options.max_trials)) {
    if (!IsSpread(pairs, triple)) continue;
    const auto start = Umeyama(pairs, triple);
    if (!start) continue;
    // Three points carry their errors outwards; the others are judged after they had their say.
    std::vector<size_t> inliers = Inliers(pairs, *start, 2 * options.limit_sigma);
    if (inliers.size() < 3 || inliers.size() < best.size()) continue;
    const Similarity3 fit = LeastSquares(pairs, inliers, *start);
    inliers = Inliers(pairs, fit, options.limit_sigma);
    const double squares = WeightedSquares(pairs, inliers, fit);
    if (inliers.size() > best.size() || (inliers.size() == best.size() && squares < best_squares)) {
      best = inliers;
      best_squares = squares;
    }
  }
  if (best.size() < 3 || !IsSpread(pairs, best)) return std::nullopt;
  return best;
}

// Whether the pairs agree far better with their source mirrored: more of them agree at all, and to
// these the best fit as given is ten times as far off, and by more than noise.
bool IsMirrored(const std::vector<SimilarityPair>& pairs, size_t inliers,
                const SimilarityOptions& options) {
  std::vector<SimilarityPair> mirrored = pairs;
  for (SimilarityPair& pair : mirrored) pair.source.z() = -pair.source.z();
  const auto agreeing = Consensus(mirrored, options);
  if (!agreeing || agreeing->size() < 4 || agreeing->size() <= inliers) return false;
  const auto squares = [&](const std::vector<SimilarityPair>& any) {
    const auto start = Umeyama(any, *agreeing);
    return start ? std::optional(
                       WeightedSquares(any, *agreeing, LeastSquares(any, *agreeing, *start)))
                 : std::nullopt;
  };
  const auto as_given = squares(pairs), as_mirrored = squares(mirrored);
  const double noise = 9.0 * static_cast<double>(agreeing->size());  // 3 sigma on each axis at most
  return as_given && as_mirrored && *as_given > 10 * noise && *as_given > 100 * *as_mirrored;
}

// Isotropic.
double Weight(const SimilarityPair& pair) { return 1 / (pair.sigma.x() * pair.sigma.x()); }

CenteredPairs WeightedCentered(const std::vector<SimilarityPair>& pairs) {
  CenteredPairs centered{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), pairs};
  double weights = 0;
  for (const SimilarityPair& pair : pairs) {
    centered.source_origin += Weight(pair) * pair.source;
    centered.target_origin += Weight(pair) * pair.target;
    weights += Weight(pair);
  }
  centered.source_origin /= weights;
  centered.target_origin /= weights;
  for (SimilarityPair& pair : centered.pairs) {
    pair.source -= centered.source_origin;
    pair.target -= centered.target_origin;
  }
  return centered;
}

// Of pairs about their centroids; nullopt: they lie on a line.
std::optional<Similarity3> WeightedUmeyama(const std::vector<SimilarityPair>& pairs) {
  Eigen::Matrix3d mixed = Eigen::Matrix3d::Zero(), spread = Eigen::Matrix3d::Zero();
  for (const SimilarityPair& pair : pairs) {
    mixed += Weight(pair) * pair.target * pair.source.transpose();
    spread += Weight(pair) * pair.source * pair.source.transpose();
  }
  const Eigen::Vector3d extent = EigenOfSymmetric(spread).values;
  if (!(extent[1] > 1e-8 * extent[2])) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(mixed, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign.z() = -1;
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  return Similarity3{svd.singularValues().dot(sign) / spread.trace(),
                     Eigen::Quaterniond(rotation).normalized(), Eigen::Vector3d::Zero()};
}

// About other origins than the centroids.
Similarity3 Uncentered(const CenteredPairs& centered, const Similarity3& fit) {
  return Similarity3{1, Eigen::Quaterniond::Identity(), centered.target_origin} * fit *
         Similarity3{1, Eigen::Quaterniond::Identity(), -centered.source_origin};
}

}  // namespace

Similarity3 operator*(const Similarity3& c_from_b, const Similarity3& b_from_a) {
  return {c_from_b.scale * b_from_a.scale, (c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b * b_from_a.translation};
}

Similarity3 Inverse(const Similarity3& b_from_a) {
  const Eigen::Quaterniond inverse = b_from_a.rotation.conjugate();
  return {1 / b_from_a.scale, inverse, -(inverse * b_from_a.translation) / b_from_a.scale};
}

Rigid3 CamFromTarget(const Rigid3& cam_from_source, const Similarity3& target_from_source) {
  const Eigen::Quaterniond rotation =
      (cam_from_source.rotation * target_from_source.rotation.conjugate()).normalized();
  return {rotation, -(rotation * (target_from_source * Center(cam_from_source)))};
}

void SimilarityOptions::Check() const {
  INSITU_CHECK(limit_sigma > 0);
  INSITU_CHECK(max_trials > 0);
}

std::optional<SimilarityFit> FitSimilarity(const std::vector<SimilarityPair>& pairs,
                                           const SimilarityOptions& options) {
  options.Check();
  for (const SimilarityPair& pair : pairs) INSITU_CHECK(pair.sigma.minCoeff() > 0);
  if (pairs.size() < 3) return std::nullopt;
  const CenteredPairs centered = Centered(pairs);
  const auto inliers = Consensus(centered.pairs, options);
  if (!inliers) return std::nullopt;
  const auto start = Umeyama(centered.pairs, *inliers);
  if (!start) return std::nullopt;
  const Similarity3 fit = LeastSquares(centered.pairs, *inliers, *start);

  SimilarityFit result;
  result.target_from_source = Uncentered(centered, fit);
  result.is_inlier.assign(pairs.size(), false);
  for (const size_t i : *inliers) result.is_inlier[i] = true;
  result.inliers = static_cast<int>(inliers->size());
  double squares = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    result.residuals.push_back(fit * centered.pairs[i].source - centered.pairs[i].target);
    if (result.is_inlier[i]) squares += result.residuals[i].squaredNorm();
  }
  result.rms = std::sqrt(squares / result.inliers);
  result.covariance = Cofactor(Normal(centered.pairs, *inliers, fit));
  const int redundancy = 3 * result.inliers - 7;
  if (redundancy > 0) {
    result.sigma0 = std::sqrt(WeightedSquares(centered.pairs, *inliers, fit) / redundancy);
  }
  result.is_mirrored = IsMirrored(centered.pairs, inliers->size(), options);
  return result;
}

std::optional<AdjustedSimilarity> AdjustSimilarity(const std::vector<SimilarityPair>& pairs,
                                                   bool adjust_scale) {
  for (const SimilarityPair& pair : pairs) {
    INSITU_CHECK(pair.sigma.x() > 0 && (pair.sigma.array() == pair.sigma.x()).all());
  }
  if (pairs.size() < 3) return std::nullopt;
  const CenteredPairs centered = WeightedCentered(pairs);
  auto fit = WeightedUmeyama(centered.pairs);
  if (!fit) return std::nullopt;
  AdjustedSimilarity result;
  result.free_scale = fit->scale;
  if (!adjust_scale) fit->scale = 1;
  result.target_from_source = Uncentered(centered, *fit);
  std::vector<size_t> all(pairs.size());
  std::iota(all.begin(), all.end(), size_t{0});
  for (const SimilarityPair& pair : centered.pairs) {
    result.residuals.push_back(*fit * pair.source - pair.target);
  }
  result.redundancy = 3 * static_cast<int>(pairs.size()) - (adjust_scale ? 7 : 6);
  result.sigma0 = std::sqrt(WeightedSquares(centered.pairs, all, *fit) / result.redundancy);
  // About the weighted centroids nothing ties the scale to the other six.
  result.covariance = Cofactor(Normal(centered.pairs, all, *fit));
  if (!adjust_scale) {
    result.covariance.row(6).setZero();
    result.covariance.col(6).setZero();
  }
  return result;
}

}  // namespace insitu
