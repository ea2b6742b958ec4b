// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/best_photo.h"

#include <algorithm>
#include <cmath>

#include "reconstruction/geometry/lens_view.h"
#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

bool ShowsAll(const PosedCamera& posed, const std::vector<Eigen::Vector3d>& vertices) {
  const LensView view(posed.camera);
  return std::all_of(vertices.begin(), vertices.end(), [&](const Eigen::Vector3d& vertex) {
    return view.PixelOf(posed.cam_from_world * vertex).has_value();
  });
}

}  // namespace

std::vector<PhotoOfPolygon> RankPhotosOf(const std::vector<PosedCamera>& cameras,
                                         const std::vector<Eigen::Vector3d>& vertices) {
  if (vertices.size() < 3) return {};
  const Eigen::Vector3d normal = OutlineNormal(vertices);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : vertices) {
    middle += (vertex - vertices[0]) / static_cast<double>(vertices.size());
  }
  middle += vertices[0];
  std::vector<PhotoOfPolygon> front, back;
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (!ShowsAll(cameras[i], vertices)) continue;
    const Eigen::Vector3d sight = Center(cameras[i].cam_from_world) - middle;
    const double cosine = normal.dot(sight.normalized());
    PhotoOfPolygon ranked{i};
    ranked.mm_per_px = 1000 * sight.norm() / cameras[i].camera.focal_px();
    ranked.angle = std::acos(std::min(1.0, std::abs(cosine)));
    ranked.score = 1000 * std::abs(cosine) / ranked.mm_per_px;
    (cosine > 0 ? front : back).push_back(ranked);
  }
  std::vector<PhotoOfPolygon>& ranking = front.empty() ? back : front;
  std::stable_sort(ranking.begin(), ranking.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return std::move(ranking);
}

}  // namespace insitu
