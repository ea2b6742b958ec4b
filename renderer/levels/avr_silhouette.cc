// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/parallel_for.h>

#include <atomic>

#include "renderer/levels/avr_levels.h"
#include "renderer/levels/drawn_picture.h"

namespace insitu {
namespace {

constexpr float kOpacity = 0.7F;
constexpr int kLinesAcross = 4;  // of a pixel at the edge

class SilhouetteRays {
 public:
  explicit SilhouetteRays(const DrawnView& view)
      : view_(view),
        world_from_cam_(Inverse(view.camera.cam_from_world)),
        eye_(world_from_cam_.translation - view.scene.natural.scene.origin) {}

  bool Hits(double x, double y) const {
    const Eigen::Vector3d direction =
        (world_from_cam_.rotation * view_.camera.camera.Unproject({x, y})).normalized();
    return view_.scene.artificial_rays.IsOccluded({eye_, direction});
  }

  // Of a pixel whose neighbours' centres do not all say the same.
  float Share(int x, int y) const {
    int hits = 0;
    for (int i = 0; i < kLinesAcross; ++i) {
      for (int j = 0; j < kLinesAcross; ++j) {
        hits += Hits(x + (i + 0.5) / kLinesAcross - 0.5, y + (j + 0.5) / kLinesAcross - 0.5);
      }
    }
    return static_cast<float>(hits) / (kLinesAcross * kLinesAcross);
  }

 private:
  const DrawnView& view_;
  const Rigid3 world_from_cam_;
  const Eigen::Vector3d eye_;
};

// Whether all of a pixel's neighbours are as it is; beyond the frame there are none.
bool IsWithin(const Raster& centers, int x, int y) {
  for (int v = std::max(0, y - 1); v <= std::min(centers.height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(centers.width - 1, x + 1); ++u) {
      if (*centers.At(u, v) != *centers.At(x, y)) return false;
    }
  }
  return true;
}

}  // namespace

RenderResult DrawSilhouette(const DrawnView& view) {
  const SilhouetteRays rays(view);
  const int width = view.photo.width, height = view.photo.height;
  Raster centers(width, height, 1), shares(width, height, 1);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) *centers.At(x, y) = rays.Hits(x, y) ? 1.0F : 0.0F;
  });
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float share = IsWithin(centers, x, y) ? *centers.At(x, y) : rays.Share(x, y);
      *shares.At(x, y) = kOpacity * share;
    }
  });
  return DrawnOnto(view, shares);
}

}  // namespace insitu
