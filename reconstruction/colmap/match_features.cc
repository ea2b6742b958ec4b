// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/match_features.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr int kLength = 128;          // of a descriptor
constexpr double kUnit = 512;         // the length to which COLMAP quantises descriptors
constexpr int kMinCoarseMatches = 4;  // fewer tell nothing

using Widened = Eigen::Matrix<int16_t, Eigen::Dynamic, kLength, Eigen::RowMajor>;

struct Best {
  int cosine = -1, second_cosine = -1;  // times kUnit^2
  int feature = -1;
};

void Update(int cosine, int feature, Best* best) {
  if (cosine > best->cosine) {
    best->second_cosine = best->cosine;
    best->cosine = cosine;
    best->feature = feature;
  } else if (cosine > best->second_cosine) {
    best->second_cosine = cosine;
  }
}

// 16-bit factors and a 32-bit sum become one instruction for eight products, on every x86-64.
int Cosine(const int16_t* first, const int16_t* second) {
  int sum = 0;
  for (int k = 0; k < kLength; ++k) sum += first[k] * second[k];
  return sum;
}

double Angle(int cosine) { return std::acos(std::min(cosine / (kUnit * kUnit), 1.0)); }

bool IsClear(const Best& best, const FeatureMatching& options) {
  if (best.feature < 0) return false;
  const double angle = Angle(best.cosine);
  return angle <= options.max_angle && angle < options.max_ratio * Angle(best.second_cosine);
}

double ScaleOf(const ColmapFeatures& features, Eigen::Index i) {
  if (features.cols() == 6) {  // an affine shape
    return std::sqrt(std::abs(double{features(i, 2)} * features(i, 5) -
                              double{features(i, 3)} * features(i, 4)));
  }
  return features.cols() >= 3 ? features(i, 2) : 1;
}

ColmapDescriptors Coarsest(const ColmapFeatures& features, const ColmapDescriptors& descriptors,
                           int count) {
  std::vector<Eigen::Index> order(static_cast<size_t>(descriptors.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return ScaleOf(features, a) > ScaleOf(features, b);
  });
  order.resize(std::min(order.size(), static_cast<size_t>(count)));
  ColmapDescriptors coarsest(static_cast<Eigen::Index>(order.size()), kLength);
  for (size_t i = 0; i < order.size(); ++i) {
    coarsest.row(static_cast<Eigen::Index>(i)) = descriptors.row(order[i]);
  }
  return coarsest;
}

std::vector<ColmapPair> EveryPair(const std::vector<uint32_t>& images) {
  std::vector<ColmapPair> pairs;
  for (size_t i = 0; i < images.size(); ++i) {
    for (size_t k = i + 1; k < images.size(); ++k) pairs.emplace_back(images[i], images[k]);
  }
  return pairs;
}

// The best `count` partners of each image by descending score, into `chosen`.
void AddPartners(const std::map<ColmapPair, double>& scores, int count,
                 std::set<ColmapPair>* chosen) {
  std::map<uint32_t, std::vector<std::pair<double, ColmapPair>>> partners;
  for (const auto& [pair, score] : scores) {
    partners[pair.first].emplace_back(-score, pair);
    partners[pair.second].emplace_back(-score, pair);
  }
  for (auto& [image, ranked] : partners) {
    std::sort(ranked.begin(), ranked.end());
    ranked.resize(std::min(ranked.size(), static_cast<size_t>(count)));
    for (const auto& [score, pair] : ranked) chosen->insert(pair);
  }
}

std::map<ColmapPair, double> CoarseScores(const std::map<uint32_t, ColmapFeatures>& features,
                                          const std::map<uint32_t, ColmapDescriptors>& descriptors,
                                          const std::vector<ColmapPair>& pairs,
                                          int coarse_features) {
  std::map<uint32_t, ColmapDescriptors> coarse;
  for (const auto& [image, rows] : descriptors) {
    coarse[image] = Coarsest(features.at(image), rows, coarse_features);
  }
  std::vector<size_t> counts(pairs.size());
  tbb::parallel_for(size_t{0}, pairs.size(), [&](size_t i) {
    counts[i] = MatchFeatures(coarse.at(pairs[i].first), coarse.at(pairs[i].second)).size();
  });
  std::map<ColmapPair, double> scores;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (counts[i] >= kMinCoarseMatches) scores[pairs[i]] = static_cast<double>(counts[i]);
  }
  return scores;
}

}  // namespace

void FeatureMatching::Check() const {
  INSITU_CHECK(max_ratio > 0);
  INSITU_CHECK(max_angle > 0);
}

void PairSelection::Check() const {
  INSITU_CHECK(exhaustive_photos >= 0);
  INSITU_CHECK(neighbours >= 0);
  INSITU_CHECK(partners >= 0);
  INSITU_CHECK(coarse_features >= 0);
}

ColmapMatches MatchFeatures(const ColmapDescriptors& first, const ColmapDescriptors& second,
                            const FeatureMatching& options) {
  options.Check();
  const Widened a = first.cast<int16_t>(), b = second.cast<int16_t>();
  std::vector<Best> of_first(static_cast<size_t>(a.rows())),
      of_second(static_cast<size_t>(b.rows()));
  constexpr Eigen::Index kBlock = 64;  // rows that stay in the cache with all of a
  for (Eigen::Index begin = 0; begin < b.rows(); begin += kBlock) {
    const Eigen::Index end = std::min(begin + kBlock, b.rows());
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      for (Eigen::Index k = begin; k < end; ++k) {
        const int cosine = Cosine(a.row(i).data(), b.row(k).data());
        Update(cosine, static_cast<int>(k), &of_first[static_cast<size_t>(i)]);
        Update(cosine, static_cast<int>(i), &of_second[static_cast<size_t>(k)]);
      }
    }
  }
  ColmapMatches matches;
  for (size_t i = 0; i < of_first.size(); ++i) {
    if (!IsClear(of_first[i], options)) continue;
    const Best& back = of_second[static_cast<size_t>(of_first[i].feature)];
    if (back.feature == static_cast<int>(i) && IsClear(back, options)) {
      matches.emplace_back(static_cast<uint32_t>(i), static_cast<uint32_t>(of_first[i].feature));
    }
  }
  return matches;
}

std::vector<ColmapPair> ChoosePairs(const std::map<uint32_t, ColmapFeatures>& features,
                                    const std::map<uint32_t, ColmapDescriptors>& descriptors,
                                    const std::map<uint32_t, Eigen::Vector3d>& centers,
                                    const PairSelection& selection) {
  selection.Check();
  std::vector<uint32_t> images;
  for (const auto& [image, rows] : descriptors) images.push_back(image);
  const std::vector<ColmapPair> every_pair = EveryPair(images);
  if (static_cast<int>(images.size()) <= selection.exhaustive_photos) return every_pair;
  std::set<ColmapPair> chosen;
  for (size_t i = 0; i < images.size(); ++i) {
    for (size_t k = i + 1; k < images.size() && k <= i + static_cast<size_t>(selection.neighbours);
         ++k) {
      chosen.emplace(images[i], images[k]);
    }
  }
  AddPartners(CoarseScores(features, descriptors, every_pair, selection.coarse_features),
              selection.partners, &chosen);
  std::map<ColmapPair, double> nearness;
  for (const ColmapPair& pair : every_pair) {
    const auto first = centers.find(pair.first), second = centers.find(pair.second);
    if (first == centers.end() || second == centers.end()) continue;
    nearness[pair] = -(first->second - second->second).norm();
  }
  AddPartners(nearness, selection.partners, &chosen);
  return {chosen.begin(), chosen.end()};
}

}  // namespace insitu
