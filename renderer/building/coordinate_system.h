// SPDX-License-Identifier: GPL-3.0-or-later
// Projected coordinate systems, by PROJ; grids are never fetched from the network.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>

namespace insitu {

class CoordinateTransformation {
 public:
  // Names as PROJ knows them ("EPSG:2056"). Throws InputError at `file`: one that it does not know,
  // or that is not in metres.
  CoordinateTransformation(const std::filesystem::path& file, const std::string& from,
                           const std::string& to);
  ~CoordinateTransformation();
  // East, north, height [m]. Throws InputError: the point has no image.
  Eigen::Vector3d Apply(const Eigen::Vector3d& point) const;

 private:
  struct Proj;
  std::filesystem::path file_;
  std::string names_;
  std::unique_ptr<Proj> proj_;
};

}  // namespace insitu
