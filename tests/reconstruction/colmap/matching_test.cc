// SPDX-License-Identifier: GPL-3.0-or-later
// What stands between photographs and COLMAP: matches, pairs and ideal frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "calibration/files/error.h"
#include "reconstruction/colmap/colmap_run.h"
#include "reconstruction/colmap/ideal_frame.h"
#include "reconstruction/colmap/match_features.h"

namespace insitu {
namespace {

// Random directions of length 512 without negative parts, as COLMAP quantises them.
ColmapDescriptors RandomDescriptors(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  ColmapDescriptors descriptors(count, 128);
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd direction(128);
    for (double& value : direction) value = std::abs(normal(generator));
    direction *= 512 / direction.norm();
    descriptors.row(i) = direction.cwiseMin(255).array().round().cast<uint8_t>().transpose();
  }
  return descriptors;
}

// What Check says; empty: nothing.
template <typename Options>
std::string FaultOf(const Options& options) {
  try {
    options.Check();
  } catch (const CheckError& error) {
    return error.what();
  }
  return "";
}

TEST(ColmapOptions, NameTheFieldThatIsWrong) {
  using testing::HasSubstr;
  EXPECT_EQ(FaultOf(ColmapOptions()), "");
  ColmapOptions options;
  options.max_image_size = 0;
  EXPECT_THAT(FaultOf(options), HasSubstr("max_image_size"));
  options.pairs.neighbours = -1;
  EXPECT_THAT(FaultOf(options), HasSubstr("neighbours"));
  EXPECT_THAT(FaultOf(FeatureMatching{.max_ratio = 0}), HasSubstr("max_ratio"));
  EXPECT_THAT(FaultOf(FeatureMatching{.max_angle = -1}), HasSubstr("max_angle"));
  EXPECT_THAT(FaultOf(PairSelection{.exhaustive_photos = -1}), HasSubstr("exhaustive_photos"));
  EXPECT_THAT(FaultOf(PairSelection{.partners = -1}), HasSubstr("partners"));
  EXPECT_THAT(FaultOf(PairSelection{.coarse_features = -1}), HasSubstr("coarse_features"));
  EXPECT_THROW(RunColmap({}, "", options), CheckError);
}

TEST(MatchFeatures, FindsAPermutationAndNothingElse) {
  const ColmapDescriptors first = RandomDescriptors(300, 1);
  std::vector<int> order(300);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(2));
  ColmapDescriptors second = RandomDescriptors(500, 3);
  for (int i = 0; i < 200; ++i) second.row(order[i]) = first.row(i);
  const ColmapMatches matches = MatchFeatures(first, second);
  ASSERT_EQ(matches.size(), 200u);
  for (uint32_t i = 0; i < 200; ++i) {
    EXPECT_EQ(matches[i], (std::pair<uint32_t, uint32_t>(i, order[i])));
  }
}

TEST(MatchFeatures, LeavesOutWhatLooksLikeTwo) {
  ColmapDescriptors first = RandomDescriptors(10, 1);
  first.row(7) = first.row(3);
  const ColmapMatches matches = MatchFeatures(first, first);
  EXPECT_EQ(matches.size(), 8u);
  EXPECT_TRUE(std::none_of(matches.begin(), matches.end(),
                           [](const auto& match) { return match.first == 3 || match.first == 7; }));
  EXPECT_TRUE(MatchFeatures(first, ColmapDescriptors(0, 128)).empty());
}

TEST(ChoosePairs, AreAllOfAFewAndTheLikeliestOfMany) {
  std::map<uint32_t, ColmapFeatures> features;
  std::map<uint32_t, ColmapDescriptors> descriptors;
  for (uint32_t image = 1; image <= 12; ++image) {
    descriptors[image] = RandomDescriptors(20, image);
    features[image] = ColmapFeatures::Ones(20, 4);
  }
  descriptors[12] = descriptors[2];  // the walk comes back to where it began
  EXPECT_EQ(ChoosePairs(features, descriptors, {}).size(), 66u);
  const PairSelection selection{.exhaustive_photos = 5, .neighbours = 1, .partners = 1};
  const auto pairs = ChoosePairs(features, descriptors, {}, selection);
  EXPECT_EQ(pairs.size(), 12u);
  EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), ColmapPair(2, 12)));
  const auto with_centers =
      ChoosePairs(features, descriptors, {{3, {0, 0, 0}}, {9, {1, 0, 0}}}, selection);
  EXPECT_TRUE(std::binary_search(with_centers.begin(), with_centers.end(), ColmapPair(3, 9)));
}

TEST(IdealFrame, ShowsWhatTheLensShows) {
  const std::vector<double> thin = {1500, 1505, 890, 610, -0.15, 0.04, 1e-3, -2e-3,
                                    0.01, 0,    0,   0,   1e-3,  2e-3, 0,    0};
  const std::vector<double> shifted = {1500, 1500, 900, -400, -0.1, 0.02, 0, 0};
  for (const Camera& camera : {Camera("LENSMODEL_OPENCV12", thin, 1800, 1200),
                               Camera("LENSMODEL_OPENCV4", shifted, 1800, 1200)}) {
    const Camera ideal = IdealFrame(camera);
    EXPECT_TRUE(ideal.Sees({ideal.intrinsics()[2], ideal.intrinsics()[3]}));
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(1799, 1199), Eigen::Vector2d(321, 1100)}) {
      const Eigen::Vector2d there = IdealFromPixel(ideal, camera, pixel);
      EXPECT_TRUE(ideal.Sees(there));
      EXPECT_LT((*camera.Project(ideal.Unproject(there)) - pixel).norm(), 1e-8);
    }
  }
}

}  // namespace
}  // namespace insitu
