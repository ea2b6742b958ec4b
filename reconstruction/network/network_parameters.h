// SPDX-License-Identifier: GPL-3.0-or-later
// The unknowns of a network as arrays of numbers at addresses that stay, as a solver wants them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "reconstruction/network/network.h"

namespace insitu {

// Whether any parameter of its lens is an unknown.
bool IsAdjusted(const NetworkCamera& camera);

// The network must outlive it; its lists must keep their lengths.
class NetworkParameters {
 public:
  explicit NetworkParameters(Network* network);
  NetworkParameters(const NetworkParameters&) = delete;
  NetworkParameters& operator=(const NetworkParameters&) = delete;

  void Load();   // the network's values into the arrays, but for lenses
  void Store();  // and back, with lenses that are adjusted

  double* Rotation(int photo) { return &values_[size_t{7} * photo]; }  // x, y, z, w
  double* Center(int photo) { return &values_[size_t{7} * photo + 4]; }
  double* Point(int point) { return &values_[first_point_ + size_t{3} * point]; }
  double* Normal(int plane) { return &values_[first_plane_ + size_t{4} * plane]; }
  double* Offset(int plane) { return Normal(plane) + 3; }
  double* Unit(int direction) { return &values_[first_direction_ + size_t{3} * direction]; }
  double* Unit(const UnitReference& reference);  // of a plane or a direction
  std::vector<double>& Lens(int camera) { return lenses_[camera]; }

 private:
  Network& network_;
  // One array for all, since Ceres orders blocks by address: the same order in every run.
  std::vector<double> values_;
  size_t first_point_ = 0, first_plane_ = 0, first_direction_ = 0;
  std::vector<std::vector<double>> lenses_;  // by camera
};

}  // namespace insitu
