// SPDX-License-Identifier: GPL-3.0-or-later
// Which features of two photographs look alike, and which pairs of photographs are worth asking.
// COLMAP's own matcher without a graphics card searches approximately and at random (FLANN seeds
// itself), so that its tie points differ from run to run; this one is exact and always the same.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reconstruction/colmap/colmap_database.h"

namespace insitu {

struct FeatureMatching {
  double max_ratio = 0.8;  // angle to the best over that to the second best [Lowe 2004]
  double max_angle = 0.7;  // [rad], between the descriptors

  void Check() const;  // throws CheckError that names the field: one that is not above 0
};

// Mutual best matches, in the order of the first photograph's features, by the angle between
// descriptors.
ColmapMatches MatchFeatures(const ColmapDescriptors& first, const ColmapDescriptors& second,
                            const FeatureMatching& options = {});

struct PairSelection {
  int exhaustive_photos = 40;  // up to so many photos every pair is matched
  int neighbours = 10;         // in the order of names, as one walks
  int partners = 20;           // of each photo: those whose coarsest features match best
  int coarse_features = 400;   // of each photo, asked for partners [Wu 2013, preemptive matching]

  void Check() const;  // throws CheckError that names the field: one below 0
};

// Pairs of images to be matched, sorted. `centers`, where known, add each photo's nearest ones.
std::vector<ColmapPair> ChoosePairs(const std::map<uint32_t, ColmapFeatures>& features,
                                    const std::map<uint32_t, ColmapDescriptors>& descriptors,
                                    const std::map<uint32_t, Eigen::Vector3d>& centers,
                                    const PairSelection& selection = {});

}  // namespace insitu
