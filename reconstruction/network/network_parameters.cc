// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/network_parameters.h"

#include <algorithm>
#include <variant>

#include "calibration/lens/lens_residual.h"

namespace insitu {

bool IsAdjusted(const NetworkCamera& camera) {
  return std::find(camera.is_free.begin(), camera.is_free.end(), true) != camera.is_free.end();
}

NetworkParameters::NetworkParameters(Network* network) : network_(*network) {
  first_point_ = 7 * network_.photos.size();
  first_plane_ = first_point_ + 3 * network_.points.size();
  first_direction_ = first_plane_ + 4 * network_.planes.size();
  values_.resize(first_direction_ + 3 * network_.directions.size());
  for (const NetworkCamera& camera : network_.cameras) {
    lenses_.push_back(LensParameters(camera.lens));
  }
  Load();
}

void NetworkParameters::Load() {
  const auto put = [](const auto& vector, double* target) {
    std::copy(vector.data(), vector.data() + vector.size(), target);
  };
  for (int i = 0; i < static_cast<int>(network_.photos.size()); ++i) {
    put(network_.photos[i].cam_from_local.coeffs(), Rotation(i));
    put(network_.photos[i].center, Center(i));
  }
  for (int i = 0; i < static_cast<int>(network_.points.size()); ++i) {
    put(network_.points[i].position, Point(i));
  }
  for (int i = 0; i < static_cast<int>(network_.planes.size()); ++i) {
    put(network_.planes[i].normal, Normal(i));
    *Offset(i) = network_.planes[i].offset;
  }
  for (int i = 0; i < static_cast<int>(network_.directions.size()); ++i) {
    put(network_.directions[i].unit, Unit(i));
  }
}

void NetworkParameters::Store() {
  using Eigen::Vector3d;
  for (int i = 0; i < static_cast<int>(network_.photos.size()); ++i) {
    network_.photos[i].cam_from_local = Eigen::Quaterniond(Rotation(i)).normalized();
    network_.photos[i].center = Vector3d(Center(i));
  }
  for (int i = 0; i < static_cast<int>(network_.points.size()); ++i) {
    network_.points[i].position = Vector3d(Point(i));
  }
  for (int i = 0; i < static_cast<int>(network_.planes.size()); ++i) {
    network_.planes[i].normal = Vector3d(Normal(i)).normalized();
    network_.planes[i].offset = *Offset(i);
  }
  for (int i = 0; i < static_cast<int>(network_.directions.size()); ++i) {
    network_.directions[i].unit = Vector3d(Unit(i)).normalized();
  }
  for (size_t i = 0; i < network_.cameras.size(); ++i) {
    if (!IsAdjusted(network_.cameras[i])) continue;
    network_.cameras[i].lens = WithParameters(network_.cameras[i].lens, lenses_[i]);
  }
}

double* NetworkParameters::Unit(const UnitReference& reference) {
  if (const auto* plane = std::get_if<PlaneNormal>(&reference)) {
    return Normal(plane->plane);
  }
  return Unit(std::get<DirectionUnit>(reference).direction);
}

}  // namespace insitu
