// SPDX-License-Identifier: GPL-3.0-or-later
// COLMAP's SQLite database: photographs, their keypoints and what was matched between them. Pixels
// are COLMAP's own; calibration/lens/colmap_lens.h converts. [colmap.github.io/database.html]
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/lens/colmap_lens.h"
#include "calibration/lens/rigid3.h"

namespace insitu {

struct ColmapDatabaseImage {
  std::string name;  // of its file, with ending, relative to the folder of images
  uint32_t camera = 0;
  std::optional<Eigen::Vector3d> prior_center = {};  // where COLMAP 3.8 looks for neighbours
};

// n x 2, 4 or 6: x, y, then scale and orientation or an affine shape. Single precision, about
// 2e-4 px at 4000 px: marks of a surveyor have no place here.
using ColmapFeatures = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// What each of an image's features looks like: SIFT, one row a feature.
using ColmapDescriptors = Eigen::Matrix<uint8_t, Eigen::Dynamic, 128, Eigen::RowMajor>;

// Images of a pair by id, first < second; a match names a keypoint of each.
using ColmapPair = std::pair<uint32_t, uint32_t>;
using ColmapMatches = std::vector<std::pair<uint32_t, uint32_t>>;

// What geometric verification left of the matches.
struct ColmapTwoViewGeometry {
  int config = 0;  // COLMAP's TwoViewGeometry::ConfigurationType
  ColmapMatches inliers;
  std::optional<Eigen::Matrix3d> fundamental, essential, homography;
  std::optional<Rigid3> second_from_first;  // translation of any length
};

// Descriptors are left out.
struct ColmapDatabase {
  std::map<uint32_t, ColmapLens> cameras;
  std::map<uint32_t, ColmapDatabaseImage> images;
  std::map<uint32_t, ColmapFeatures> features;  // by image
  std::map<ColmapPair, ColmapMatches> matches;
  std::map<ColmapPair, ColmapTwoViewGeometry> two_view_geometries;
};

// 2147483647 first + second, the key of a pair. Needs first < second < 2147483647.
uint64_t ColmapPairId(const ColmapPair& pair);

// Reads a database of COLMAP 3.8 to 4.x. Throws InputError with file, table and row: no database,
// damaged or cut short, an unknown lens model, data of another size than stated, a reference to
// an image, camera or keypoint that is not there.
ColmapDatabase ReadColmapDatabase(const std::filesystem::path& path);

// By image. Throws InputError: no database, damaged, not 128 bytes a feature, another number of
// them than `database.features` holds.
std::map<uint32_t, ColmapDescriptors> ReadColmapDescriptors(const std::filesystem::path& path,
                                                            const ColmapDatabase& database);

// Makes a new database with COLMAP 3.8's tables, which later versions read; whole or not at all.
void WriteColmapDatabase(const std::filesystem::path& path, const ColmapDatabase& database);

// Sets cameras and keypoints of those ids that are given, in place, and leaves the rest, such as
// descriptors, as it is. Throws InputError.
void UpdateColmapDatabase(const std::filesystem::path& path,
                          const std::map<uint32_t, ColmapLens>& cameras,
                          const std::map<uint32_t, ColmapFeatures>& features);

}  // namespace insitu
