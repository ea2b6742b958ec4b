// SPDX-License-Identifier: GPL-3.0-or-later
// A sparse model of COLMAP as its files hold it, text or binary, of COLMAP 3.8 to 4.x. Pixels are
// COLMAP's own; calibration/lens/colmap_lens.h converts. [colmap.github.io/format.html]
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/colmap_lens.h"
#include "calibration/lens/rigid3.h"

namespace insitu {

struct ColmapKeypoint {
  Eigen::Vector2d position;       // COLMAP's pixels
  std::optional<uint64_t> point;  // id; nullopt: of no point
  bool operator==(const ColmapKeypoint&) const = default;
};

struct ColmapImage {
  std::string name;  // of its file, with ending, relative to the folder of images
  uint32_t camera = 0;
  Rigid3 cam_from_world;
  std::vector<ColmapKeypoint> keypoints;
};

struct ColmapTrackElement {
  uint32_t image = 0, keypoint = 0;  // keypoint counts from 0 within its image
  bool operator==(const ColmapTrackElement&) const = default;
};

struct ColmapPoint {
  Eigen::Vector3d position;  // world
  std::array<uint8_t, 3> rgb{};
  double error_px = 0;  // mean reprojection error; -1: not known
  std::vector<ColmapTrackElement> track;
};

// By id; ids need not be consecutive.
struct ColmapModel {
  std::map<uint32_t, ColmapLens> cameras;
  std::map<uint32_t, ColmapImage> images;
  std::map<uint64_t, ColmapPoint> points;
};

}  // namespace insitu
