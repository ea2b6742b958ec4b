// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/coordinate_system.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

CoordinateConversion Between(const std::string& source, const std::string& target) {
  return {*CoordinateSystem::FromText(source), *CoordinateSystem::FromText(target)};
}

// The old observatory of Bern is the origin of the Swiss grids; both are 2 000 000 and 1 000 000 m
// apart, but for up to two metres of the network of 1903. [swisstopo]
TEST(CoordinateConversion, TheSwissGridsAndTheirOrigin) {
  const auto bern = Between("EPSG:4326", "EPSG:2056")(Eigen::Vector2d(7.438632, 46.951083));
  ASSERT_TRUE(bern);
  EXPECT_NEAR((*bern - Eigen::Vector2d(2600000, 1200000)).norm(), 0, 2);
  const CoordinateConversion convert = Between("EPSG:21781", "EPSG:2056");
  const auto flat = convert(Eigen::Vector2d(600100, 200200));
  const auto with_height = convert.WithHeight({600100, 200200, 430});
  ASSERT_TRUE(flat && with_height);
  EXPECT_NEAR((*flat - Eigen::Vector2d(2600100, 1200200)).norm(), 0, 2);
  EXPECT_EQ(with_height->head<2>(), *flat);
  EXPECT_NEAR(with_height->z(), 430, 1);
}

// Heights in feet become metres where both systems define theirs, and only with the third
// coordinate.
TEST(CoordinateConversion, HeightsAreConvertedWhereBothSystemsHaveThem) {
  const Eigen::Vector3d point(500000, 4500000, 100);
  const auto metres = Between("EPSG:32618+6360", "EPSG:32618+5703").WithHeight(point);
  ASSERT_TRUE(metres);
  EXPECT_NEAR(metres->z(), 100 * 1200.0 / 3937, 1e-6);
  EXPECT_NEAR((metres->head<2>() - point.head<2>()).norm(), 0, 1e-6);
  const auto as_given = Between("EPSG:32618", "EPSG:32618+5703").WithHeight(point);
  ASSERT_TRUE(as_given);
  EXPECT_NEAR(as_given->z(), 100, 1e-6);
}

TEST(CoordinateConversion, APlaceThatASystemDoesNotReach) {
  EXPECT_FALSE(Between("EPSG:4326", "EPSG:2056")(Eigen::Vector2d(7, 1e9)));
  EXPECT_FALSE(Between("EPSG:4326", "EPSG:2056").WithHeight({7, 1e9, 0}));
}

TEST(CoordinateSystem, WhatIsNoSystemOfAPlace) {
  for (const char* bad : {"", "EPSG:1", "EPSG:4978", "EPSG:5703", "LV95"}) {
    EXPECT_FALSE(CoordinateSystem::FromText(bad)) << bad;
  }
}

}  // namespace
}  // namespace insitu
