// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reconstruction/survey/synthetic_tie_points.h"

#include <Eigen/Geometry>
#include <random>

namespace insitu {

std::map<std::string, Camera> CamerasOf(const SyntheticNetwork& network) {
  std::map<std::string, Camera> cameras;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    cameras.emplace(network.photos[i], network.cameras[i]);
  }
  return cameras;
}

Similarity3 ModelFromWorld() {
  return Inverse(
      Similarity3{12,
                  Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, -1).normalized())),
                  {1000, 2000, 400}});
}

TiePoints ModelOf(const SyntheticNetwork& network, int count) {
  const Similarity3 model_from_world = ModelFromWorld();
  TiePoints tie_points;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    tie_points.cam_from_model[network.photos[i]] =
        CamFromTarget(network.cam_from_world[i], model_from_world);
  }
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> along(-8, 8), up(0, 8);
  const Eigen::Vector3d middle(1000, 2000, 400);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d world =
        middle + Eigen::Vector3d(along(generator), along(generator), up(generator));
    TiePoint point{model_from_world * world, {}};
    for (size_t photo = 0; photo < network.photos.size(); ++photo) {
      const auto pixel = network.cameras[photo].Project(network.cam_from_world[photo] * world);
      if (pixel && network.cameras[photo].Sees(*pixel)) {
        point.marks.push_back({network.photos[photo], *pixel});
      }
    }
    if (point.marks.size() >= 2) tie_points.points.push_back(point);
  }
  tie_points.sigma_px = 0.5;
  return tie_points;
}

}  // namespace insitu
