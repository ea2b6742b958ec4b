// SPDX-License-Identifier: GPL-3.0-or-later
// Similarity transformations (Helmert, seven parameters), named target-from-source, and their fit
// to points known in both frames: robust where any pair may be wrong, plain where each was
// measured.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "calibration/lens/rigid3.h"

namespace insitu {

// x_in_b = scale * rotation * x_in_a + translation
struct Similarity3 {
  double scale = 1;                                              // > 0
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // in the target frame

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return scale * (rotation * point) + translation;
  }
};

// c_from_a = c_from_b * b_from_a
Similarity3 operator*(const Similarity3& c_from_b, const Similarity3& b_from_a);
Similarity3 Inverse(const Similarity3& b_from_a);

// The same camera after its world became another: it stands at target_from_source * its centre and
// looks the same way.
Rigid3 CamFromTarget(const Rigid3& cam_from_source, const Similarity3& target_from_source);

struct SimilarityPair {
  Eigen::Vector3d source, target;
  Eigen::Vector3d sigma;  // of the difference, per axis of the target; > 0
};

struct SimilarityOptions {
  double limit_sigma = 5;  // a pair that is off by more on an axis is an outlier
  int max_trials = 2000;   // of triples; all of them if there are fewer

  // Throws CheckError that names the field: one that is not above 0.
  void Check() const;
};

struct SimilarityFit {
  Similarity3 target_from_source;
  // Of (left rotation increment [rad], translation of the inliers' centroid, relative scale), from
  // the given sigmas, not scaled by sigma0.
  Eigen::Matrix<double, 7, 7> covariance;
  std::vector<Eigen::Vector3d> residuals;  // transformed source - target, of every pair
  std::vector<bool> is_inlier;
  int inliers = 0;
  double rms = 0;     // sqrt(sum |residual|^2 / inliers), of the inliers
  double sigma0 = 1;  // a posteriori, a priori 1; 1 without redundancy
  // More pairs fit a mirror image, and far better: axes are swapped or one is reversed in a frame.
  bool is_mirrored = false;
};

// Random sample consensus over triples, always the same ones, then least squares over the inliers
// with their sigmas [Umeyama 1991 for the start]. Coordinates of any size lose nothing.
// nullopt: fewer than three pairs, or the consensus has fewer than three, or they lie on one line.
std::optional<SimilarityFit> FitSimilarity(const std::vector<SimilarityPair>& pairs,
                                           const SimilarityOptions& options = {});

struct AdjustedSimilarity {
  Similarity3 target_from_source;
  std::vector<Eigen::Vector3d> residuals;  // transformed source - target
  double sigma0 = 0;                       // a posteriori; 1 if the sigmas tell the truth
  int redundancy = 0;
  // As in SimilarityFit, the centroid being the weighted one; zero for a scale that is held.
  Eigen::Matrix<double, 7, 7> covariance;
  double free_scale = 1;  // what the scale would be if it were adjusted
};

// Least squares over all pairs, in closed form; a scale that is held is 1. The sigmas of a pair
// must be alike along all axes (INSITU_CHECK). [Umeyama 1991, weighted] nullopt: fewer than three
// pairs, or all of them on one line.
std::optional<AdjustedSimilarity> AdjustSimilarity(const std::vector<SimilarityPair>& pairs,
                                                   bool adjust_scale);

}  // namespace insitu
