// SPDX-License-Identifier: GPL-3.0-or-later
// What a map says, as numbers of which means may be taken.
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "calibration/photo/raster.h"
#include "renderer/mesh/surface_map.h"

namespace insitu {

constexpr int kReliefChannels = 5;

// Codes are linear, whatever colour space the file states. One channel of roughness (a slope, not
// the root that glTF states), metal and transmission, before the factor. Of normals and heights
// five: the relief's slopes along u and v, v up, the squares of both, and their product; of normals
// per length, their factor in them, of heights as code per repeat. [tangent space of glTF: +X along
// u, +Y along v; Olano & Baker 2010]
// Throws InputError: missing, not an image.
Raster ReadDataMap(const std::filesystem::path& path, const SurfaceMap& map);

// Of a map of one channel, times its factor.
double MeanOf(const Raster& data, const SurfaceMap& map);

// Of an image of three channels, linear.
Eigen::Vector3d MeanColor(const Raster& image);

inline bool IsRelief(const SurfaceMap& map) {
  return map.kind == SurfaceMap::Kind::kNormal || map.kind == SurfaceMap::Kind::kHeight;
}
// What its numbers are multiplied by.
inline double FactorOf(const SurfaceMap& map) {
  return map.is_squared ? map.factor * map.factor : map.factor;
}

}  // namespace insitu
