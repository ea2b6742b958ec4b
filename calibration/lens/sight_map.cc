// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/sight_map.h"

#include <tbb/parallel_for.h>

#include "calibration/files/error.h"
#include "calibration/lens/catmull_rom.h"

namespace insitu {
namespace {

constexpr double kFrameBegin = -0.5;  // [px], the outer edge of the first pixel

}  // namespace

SightMap::SightMap(const Camera& camera) : columns_(camera.width() / kSpacing + 4) {
  const int rows = camera.height() / kSpacing + 4;
  tangents_.resize(static_cast<size_t>(columns_) * rows);
  tbb::parallel_for(0, rows, [&](int row) {
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector2d node((column - 1) * kSpacing, (row - 1) * kSpacing);
      const Eigen::Vector3d sight = camera.Unproject(node.array() + kFrameBegin);
      tangents_[static_cast<size_t>(row) * columns_ + column] = sight.hnormalized();
    }
  });
}

Eigen::Vector2d SightMap::Tangents(const Eigen::Vector2d& pixel) const {
  const Eigen::Array2d position = (pixel.array() - kFrameBegin) / kSpacing;
  const Eigen::Array2i cell = position.floor().cast<int>();
  const int rows = static_cast<int>(tangents_.size()) / columns_;
  INSITU_CHECK((cell >= 0).all() && cell.x() + 3 < columns_ && cell.y() + 3 < rows);
  const auto across = CatmullRomWeights(position.x() - cell.x());
  const auto down = CatmullRomWeights(position.y() - cell.y());
  Eigen::Vector2d tangents = Eigen::Vector2d::Zero();
  for (int j = 0; j < 4; ++j) {
    const Eigen::Vector2d* row = &tangents_[static_cast<size_t>(cell.y() + j) * columns_];
    for (int i = 0; i < 4; ++i) tangents += down[j] * across[i] * row[cell.x() + i];
  }
  return tangents;
}

}  // namespace insitu
