// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinate reference systems, by PROJ, without network: grids that PROJ would fetch are not used.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

namespace insitu {

class CoordinateSystem {
 public:
  // "EPSG:2056", "EPSG:2056+5728", a PROJ string, WKT, "WGS84" or "WGS84 UTM 32N" as OpenDroneMap
  // writes them. What is told and compared of a compound system is its horizontal part and the unit
  // of its heights. nullopt: PROJ does not know it, or it is neither geographic, projected nor
  // local (geocentric, vertical).
  static std::optional<CoordinateSystem> FromText(const std::string& text);

  // The WGS 84 / UTM zone of a place [deg].
  static CoordinateSystem UtmZone(double longitude_deg, double latitude_deg);

  const std::string& name() const { return name_; }  // "WGS 84 / UTM zone 32N"
  std::string Code() const;          // "EPSG:32632", or its PROJ string, or its name
  bool is_geographic() const;        // degrees
  bool is_local() const;             // a site's own axes: cannot be converted
  double metres_per_unit() const;    // 1 of a geographic system
  double metres_per_height() const;  // negative: depths; 1 of a system without heights
  bool has_north_first() const;      // its definition puts latitude or northing first

  bool operator==(const CoordinateSystem& other) const;  // the same but for names and axis order

 private:
  friend class CoordinateConversion;
  struct Definition;  // PROJ's
  explicit CoordinateSystem(std::shared_ptr<const Definition> definition);
  std::shared_ptr<const Definition> definition_;
  std::string name_;
};

class CoordinateConversion {
 public:
  CoordinateConversion(const CoordinateSystem& source, const CoordinateSystem& target);

  // (x east or longitude, y north or latitude) of the source in the target, each in its own unit, x
  // first whatever the definitions say. nullopt: PROJ has no conversion for this place.
  std::optional<Eigen::Vector2d> operator()(const Eigen::Vector2d& xy) const;

  // The same with a height, which is converted where both systems define theirs and stays as it is
  // where one has none.
  std::optional<Eigen::Vector3d> WithHeight(const Eigen::Vector3d& xyz) const;

 private:
  struct Pipelines;  // PROJ's
  std::shared_ptr<const Pipelines> pipelines_;
};

}  // namespace insitu
