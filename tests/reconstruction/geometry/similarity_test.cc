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

Similarity3 SomeSimilarity(double scale) {
  Similarity3 t;
  t.scale = scale;
  t.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, -0.2, 1).normalized());
  t.translation = {2600100, 1200200, 430};
  return t;
}

std::vector<SimilarityPair> BuildingPairs(const Similarity3& t, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  std::vector<SimilarityPair> pairs;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(20, 0, 0), Eigen::Vector3d(20, 12, 0),
        Eigen::Vector3d(0, 12, 3), Eigen::Vector3d(10, 6, 9)}) {
    const double sigma = 0.01 * (1 + static_cast<double>(pairs.size()));
    SimilarityPair pair{p, t * p, Eigen::Vector3d::Constant(sigma)};
    for (double& x : pair.target) x += noise * sigma * normal(random);
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(AdjustSimilarity, ExactPairsGiveTheTransformationBack) {
  for (const bool free : {false, true}) {
    const Similarity3 truth = SomeSimilarity(free ? 0.9 : 1);
    const auto result = AdjustSimilarity(BuildingPairs(truth, 0, 1), free);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->target_from_source.scale, truth.scale, 1e-9);
    EXPECT_NEAR(result->target_from_source.rotation.angularDistance(truth.rotation), 0, 1e-9);
    for (const SimilarityPair& pair : BuildingPairs(truth, 0, 1)) {
      EXPECT_NEAR((result->target_from_source * pair.source - pair.target).norm(), 0, 1e-8);
    }
    EXPECT_EQ(result->redundancy, free ? 8 : 9);
  }
}

// Over many samples the mean of sigma0^2 is 1, and errors are as large as their sigmas say.
TEST(AdjustSimilarity, SigmasTellTheTruth) {
  const Similarity3 truth = SomeSimilarity(1);
  constexpr int kSamples = 400;
  double sigma0_square = 0;
  Eigen::Vector3d turn_square = Eigen::Vector3d::Zero(), sigma = Eigen::Vector3d::Zero();
  for (unsigned seed = 1; seed <= kSamples; ++seed) {
    const auto result = AdjustSimilarity(BuildingPairs(truth, 1, seed), false);
    sigma0_square += result->sigma0 * result->sigma0 / kSamples;
    const Eigen::AngleAxisd turn(result->target_from_source.rotation * truth.rotation.conjugate());
    turn_square += (turn.angle() * turn.axis()).cwiseAbs2() / kSamples;
    sigma = result->covariance.diagonal().head<3>().cwiseSqrt();
  }
  EXPECT_NEAR(sigma0_square, 1, 0.1);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(turn_square[axis]) / sigma[axis], 1, 0.12) << axis;
  }
}

TEST(AdjustSimilarity, NeedsThreePairsOffALine) {
  std::vector<SimilarityPair> pairs = BuildingPairs(SomeSimilarity(1), 0, 1);
  pairs.resize(2);
  EXPECT_FALSE(AdjustSimilarity(pairs, false));
  pairs.push_back(pairs[0]);
  pairs.back().source = {40, 0, 0};
  EXPECT_FALSE(AdjustSimilarity(pairs, false));
}

// The robust fit and the closed form meet where nothing is wrong: alike sigmas, a free scale.
TEST(AdjustSimilarity, AgreesWithTheRobustFit) {
  const auto pairs = BuildingPairs(SomeSimilarity(0.9), 1, 5);
  const auto closed = AdjustSimilarity(pairs, true);
  const auto robust = FitSimilarity(pairs, {.limit_sigma = 20});
  ASSERT_TRUE(closed && robust);
  EXPECT_NEAR(closed->target_from_source.scale, robust->target_from_source.scale, 1e-9);
  EXPECT_NEAR(closed->free_scale, closed->target_from_source.scale, 1e-15);
  for (size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_NEAR((closed->residuals[i] - robust->residuals[i]).norm(), 0, 1e-8) << i;
  }
  EXPECT_NEAR(closed->sigma0, robust->sigma0, 1e-9);
  EXPECT_NEAR(closed->covariance(6, 6) / robust->covariance(6, 6), 1, 1e-6);
  EXPECT_EQ(AdjustSimilarity(pairs, false)->covariance(6, 6), 0);
}

TEST(AdjustSimilarity, RefusesSigmasThatDifferByAxis) {
  auto pairs = BuildingPairs(SomeSimilarity(1), 0, 1);
  pairs[2].sigma.z() *= 2;
  EXPECT_THROW(AdjustSimilarity(pairs, false), CheckError);
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
