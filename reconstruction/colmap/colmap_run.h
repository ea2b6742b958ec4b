// SPDX-License-Identifier: GPL-3.0-or-later
// Runs COLMAP's programs on photographs whose lenses are known: features and first poses are
// COLMAP's, matches ours (match_features.h), lenses stay as mrcal calibrated them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/colmap/colmap_model.h"
#include "reconstruction/colmap/match_features.h"
#include "reconstruction/survey/tie_points.h"

namespace insitu {

struct MatchingPhoto {
  std::filesystem::path file;
  Camera camera;
  std::optional<Eigen::Vector3d> center = {};  // [m], where it is known: neighbours are matched
};

struct ColmapOptions {
  PairSelection pairs;
  FeatureMatching matching;
  int max_image_size = 3200;  // [px], larger photographs are searched for features at this size

  void Check() const;  // throws CheckError that names the field: a size that is not above 0
};

// One connected model.
struct MatchedModel {
  TiePoints tie_points;  // marks in pixels of the original photographs, photos by stem
  ColmapModel colmap;    // as COLMAP has it, images under the photographs' file names
};

// Models of two or more photographs, the one with most photographs first; none if no two of them
// can be connected. `folder` receives COLMAP's database, models and logs.
//
// A lens that COLMAP has (PINHOLE, OPENCV, FULL_OPENCV) is given to it and held fixed. For any
// other (splined, OPENCV12 ...), or a principal point off the photograph, which COLMAP refuses,
// keypoints are moved without distortion to a pinhole frame in COLMAP's database alone: marks stay
// pixels of the original photographs. The same photographs give the same models, with any number of
// threads. Throws InputError: COLMAP is not installed or fails, naming its log.
std::vector<MatchedModel> RunColmap(const std::vector<MatchingPhoto>& photos,
                                    const std::filesystem::path& folder,
                                    const ColmapOptions& options = {});

// The marks of a model's points; `features`, if given by image, are the original keypoints in
// COLMAP's pixels that replace the model's own.
TiePoints TiePointsFromColmap(const ColmapModel& model,
                              const std::map<uint32_t, ColmapFeatures>* features = nullptr);

}  // namespace insitu
