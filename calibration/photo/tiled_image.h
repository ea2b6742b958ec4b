// SPDX-License-Identifier: GPL-3.0-or-later
// A picture that is looked into here and there without being in memory: many large photographs of
// one site would not fit. [OpenImageIO's image cache]
#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace insitu {

// Of all tiled images together, this much of their tiles is held.
inline constexpr float kTileMegabytes = 512;

class TiledImage {
 public:
  // A file of three channels of linear numbers, each of which counts times its factor. Quick where
  // the file is in tiles itself. Throws InputError.
  TiledImage(const std::filesystem::path& file, const Eigen::Vector3f& factor);

  // What Interpolate makes of the whole picture in memory, bit for bit. From any thread. Throws
  // std::runtime_error: the file is no longer what it was.
  Eigen::Vector3d At(const Eigen::Vector2d& pixel) const;

 private:
  Eigen::Vector3d Rgb(int x, int y) const;

  std::filesystem::path file_;
  Eigen::Vector3f factor_;
  void* handle_ = nullptr;                                         // of OpenImageIO's
  int width_ = 0, height_ = 0, tile_width_ = 0, tile_height_ = 0;  // [px]
};

}  // namespace insitu
