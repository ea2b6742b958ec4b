// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/clipped_shares.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr double kLookedAt = 40000;  // pixels of a photograph

struct Tally {
  int seen = 0, clipped = 0;
};

// By polygon.
std::vector<Tally> TallyClipped(const SceneGeometry& scene, const PosedCamera& posed,
                                const Photograph& photo, const PolygonMesh& polygons,
                                const RayScene& rays) {
  std::vector<Tally> tallies(scene.polygons.size());
  const Eigen::Vector3d center = Center(posed.cam_from_world);
  const Eigen::Quaterniond world_from_cam = posed.cam_from_world.rotation.conjugate();
  const Raster& image = photo.linear;
  const int step = std::max(
      1, static_cast<int>(std::sqrt(static_cast<double>(image.width) * image.height / kLookedAt)));
  for (int y = step / 2; y < image.height; y += step) {
    for (int x = step / 2; x < image.width; x += step) {
      const Eigen::Vector3d direction =
          world_from_cam * posed.camera.Unproject(Eigen::Vector2d(x, y));
      const auto hit = rays.Nearest({center - scene.origin, direction});
      if (!hit) continue;
      Tally& tally = tallies[polygons.polygon_of_triangle[hit->triangle]];
      ++tally.seen;
      tally.clipped += IsClipped(photo, x, y);
    }
  }
  return tallies;
}

}  // namespace

std::vector<ClippedShare> MeasureClippedShares(const SceneGeometry& scene,
                                               const PhotographSet& photos) {
  INSITU_CHECK(photos.size() == scene.cameras.size());
  const PolygonMesh polygons = MeshOfPolygons(scene);
  const RayScene rays(polygons.mesh);
  std::vector<ClippedShare> shares;
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto photo = photos[i];
    if (photo->encoding == Encoding::kLinear) continue;
    const auto tallies = TallyClipped(scene, scene.cameras[i], *photo, polygons, rays);
    for (size_t p = 0; p < tallies.size(); ++p) {
      if (tallies[p].clipped == 0) continue;
      shares.push_back({static_cast<int>(i), static_cast<int>(p),
                        static_cast<double>(tallies[p].clipped) / tallies[p].seen});
    }
  }
  std::ranges::stable_sort(shares, std::ranges::greater(), &ClippedShare::share);
  return shares;
}

}  // namespace insitu
