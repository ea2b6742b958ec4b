// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/similarity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/files/error.h"
#include "calibration/lens/camera.h"

namespace insitu {
namespace {

const Similarity3 kTruth{
    37.5,
    Eigen::Quaterniond(Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.2, -0.5, 0.9).normalized())),
    {2600000, 1200000, 450}};

std::vector<SimilarityPair> ExactPairs(int count, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<SimilarityPair> pairs;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d source(coordinate(generator), coordinate(generator),
                                 coordinate(generator));
    pairs.push_back({source, kTruth * source, Eigen::Vector3d::Constant(0.01)});
  }
  return pairs;
}

TEST(Similarity3, IsAGroup) {
  const Eigen::Vector3d point(0.3, -0.4, 0.7);
  EXPECT_LT((Inverse(kTruth) * (kTruth * point) - point).norm(), 1e-7);
  const Similarity3 other{0.2, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1, 2, 3}};
  EXPECT_LT(((kTruth * other) * point - kTruth * (other * point)).norm(), 1e-9);
}

TEST(CamFromTarget, ShowsTheSamePicture) {
  const Similarity3 target_from_source{3, kTruth.rotation, {10, 20, 30}};
  const Rigid3 cam_from_source{Eigen::Quaterniond(0.1, 0.2, 0.3, 0.9).normalized(), {1, 2, 9}};
  const Eigen::Vector3d point(0.3, -0.4, 0.7);
  const Eigen::Vector3d before = cam_from_source * point;
  const Eigen::Vector3d after =
      CamFromTarget(cam_from_source, target_from_source) * (target_from_source * point);
  EXPECT_LT((after - 3 * before).norm(), 1e-12);  // the same direction, three times as far
}

TEST(FitSimilarity, RecoversExactPairsInANationalGrid) {
  for (const int count : {3, 4, 10}) {
    const auto fit = FitSimilarity(ExactPairs(count));
    ASSERT_TRUE(fit) << count;
    EXPECT_EQ(fit->inliers, count);
    EXPECT_NEAR(fit->target_from_source.scale, kTruth.scale, 1e-7);
    EXPECT_LT(fit->target_from_source.rotation.angularDistance(kTruth.rotation), 1e-7);
    EXPECT_LT(fit->rms, 1e-7);
    EXPECT_FALSE(fit->is_mirrored);
    for (const SimilarityPair& pair : ExactPairs(count)) {
      EXPECT_LT((fit->target_from_source * pair.source - pair.target).norm(), 1e-7);
    }
  }
}

TEST(FitSimilarity, LeavesBlundersOut) {
  std::vector<SimilarityPair> pairs = ExactPairs(30);
  for (int i = 0; i < 30; i += 3) pairs[i].target += Eigen::Vector3d(5, -8, 3 + i);
  const auto fit = FitSimilarity(pairs);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->inliers, 20);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(fit->is_inlier[i], i % 3 != 0) << i;
  EXPECT_NEAR(fit->target_from_source.scale, kTruth.scale, 1e-7);
  EXPECT_GT(fit->residuals[0].norm(), 5);
}

// Errors of the stated sigmas, larger along z: sigma0 is about 1 and each parameter's error about
// its own sigma.
TEST(FitSimilarity, StatesItsOwnUncertainty) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  double sigma0_squares = 0, scale_squares = 0, rotation_squares = 0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<SimilarityPair> pairs = ExactPairs(8, 3);
    for (SimilarityPair& pair : pairs) {
      pair.sigma = {0.01, 0.01, 0.05};
      for (int i = 0; i < 3; ++i) pair.target[i] += pair.sigma[i] * normal(generator);
    }
    const auto fit = FitSimilarity(pairs, {.limit_sigma = 10});
    ASSERT_TRUE(fit);
    ASSERT_EQ(fit->inliers, 8);
    sigma0_squares += fit->sigma0 * fit->sigma0;
    const double scale_error = fit->target_from_source.scale / kTruth.scale - 1;
    scale_squares += scale_error * scale_error / fit->covariance(6, 6);
    const Eigen::AngleAxisd turn(fit->target_from_source.rotation * kTruth.rotation.conjugate());
    const Eigen::Vector3d rotation_error = turn.angle() * turn.axis();
    rotation_squares +=
        rotation_error.dot(fit->covariance.topLeftCorner<3, 3>().inverse() * rotation_error) / 3;
  }
  EXPECT_NEAR(sigma0_squares / kRuns, 1, 0.1);  // 4.5 sigma of the mean of 400 of 17 degrees
  EXPECT_NEAR(scale_squares / kRuns, 1, 0.3);
  EXPECT_NEAR(rotation_squares / kRuns, 1, 0.2);
}

TEST(FitSimilarity, RefusesTwoPairsAndALine) {
  EXPECT_FALSE(FitSimilarity(ExactPairs(2)));
  std::vector<SimilarityPair> pairs = ExactPairs(6);
  for (size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].source = Eigen::Vector3d(1, 2, 3) * static_cast<double>(i);
    pairs[i].target = kTruth * pairs[i].source;
  }
  EXPECT_FALSE(FitSimilarity(pairs));
}

TEST(FitSimilarity, TellsAMirrorImage) {
  std::vector<SimilarityPair> pairs = ExactPairs(8);
  for (SimilarityPair& pair : pairs) std::swap(pair.target.x(), pair.target.y());
  const auto fit = FitSimilarity(pairs);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->is_mirrored);
}

TEST(FitSimilarity, TellsAMirrorImageDespiteABlunder) {
  std::vector<SimilarityPair> pairs = ExactPairs(8);
  for (SimilarityPair& pair : pairs) std::swap(pair.target.x(), pair.target.y());
  pairs[3].target.z() += 40;
  const auto fit = FitSimilarity(pairs);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->is_mirrored);
}

TEST(FitSimilarity, TakesABlunderForNoMirrorImage) {
  for (size_t i = 0; i < 6; ++i) {
    std::vector<SimilarityPair> pairs = ExactPairs(6);
    pairs[i].target.z() += 40;
    pairs[(i + 2) % 6].target.x() -= 30;
    const auto fit = FitSimilarity(pairs);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->inliers, 4);
    EXPECT_FALSE(fit->is_mirrored);
  }
}

TEST(FitSimilarity, NamesTheOptionThatIsWrong) {
  const auto fault = [](const SimilarityOptions& options) {
    try {
      FitSimilarity({}, options);
    } catch (const CheckError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault({}), "");
  EXPECT_NE(fault({.limit_sigma = 0}).find("limit_sigma"), std::string::npos);
  EXPECT_NE(fault({.max_trials = 0}).find("max_trials"), std::string::npos);
}

}  // namespace
}  // namespace insitu
