// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinate systems by the words of people and programs: "30U", "UTM33N", "LV95", "DHDN / 3-degree
// zone 4".
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "reconstruction/geometry/coordinate_system.h"

namespace insitu {

struct NamedSystem {
  CoordinateSystem system;
  std::string remark;  // what the words were taken for; empty: PROJ's own name or code
};

// Throws InputError at `path` with the nearest names of PROJ's database: unknown, or of several
// systems.
NamedSystem SystemByWords(const std::filesystem::path& path, const std::string& text);

// Where a system is meant to be used [deg], by PROJ's database.
struct AreaOfUse {
  std::string name;
  double west = 0, south = 0, east = 0, north = 0;

  // How far outside a place lies [deg]; 0: within.
  double Excess(const Eigen::Vector2d& longitude_latitude) const;
};

// nullopt: the database has none, as of a system that a PROJ string makes.
std::optional<AreaOfUse> AreaOf(const CoordinateSystem& system);

}  // namespace insitu
