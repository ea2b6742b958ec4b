// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/polygon_rings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0, 0, 1);

Ring Box(double x, double y, double width, double height) {
  return {{x, y, 0}, {x + width, y, 0}, {x + width, y + height, 0}, {x, y + height, 0}};
}

// How many triangles a point lies in.
int Cover(const Ring& all, const std::vector<Eigen::Vector3i>& triangles, const Vector3d& point) {
  return static_cast<int>(std::count_if(triangles.begin(), triangles.end(), [&](const auto& t) {
    const auto left = [&](int i) {
      const Vector3d &a = all[t[i]], &b = all[t[(i + 1) % 3]];
      return (b - a).cross(point - a).dot(kUp) > 0;
    };
    return left(0) && left(1) && left(2);
  }));
}

std::string FaultText(const Ring& outline, const std::vector<Ring>& holes) {
  const auto fault = FaultOfRings(outline, holes, kUp);
  EXPECT_EQ(TriangulateRings(outline, holes, kUp).has_value(), !fault);
  return fault ? fault->what.text() : "";
}

// A wall of windows, some with as many corners as a round one has, on a concave outline: every
// place is in one triangle or, in a window, in none.
TEST(TriangulateRings, CoversWhatIsInNoHoleOnce) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    std::uniform_real_distribution<double> share(0.1, 0.9);
    const Ring outline = {{0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {6, 6.2, 0}, {0, 8, 0}};
    std::vector<Ring> holes;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 6; ++column) {
        Ring hole;
        const int corners = 3 + trial % 7;
        for (int i = 0; i < corners; ++i) {
          const double angle = 2 * M_PI * (trial % 2 ? i : corners - i) / corners;
          const double radius = trial % 3 == 0 ? 0.7 : 0.9 * share(random);
          hole.emplace_back(2 * column + 1 + radius * std::cos(angle),
                            2 * row + 1 + radius * std::sin(angle), 0);
        }
        holes.push_back(std::move(hole));
      }
    }
    if (trial % 3 == 1) std::shuffle(holes.begin(), holes.end(), random);
    const auto triangles = TriangulateRings(outline, holes, kUp);
    ASSERT_TRUE(triangles) << trial;
    Ring all = outline;
    double area = AreaOf(outline), sum = 0;
    for (const Ring& hole : holes) {
      all.insert(all.end(), hole.begin(), hole.end());
      area -= AreaOf(hole);
    }
    for (const Eigen::Vector3i& t : *triangles) {
      sum += (all[t[1]] - all[t[0]]).cross(all[t[2]] - all[t[0]]).dot(kUp) / 2;
    }
    EXPECT_NEAR(sum, area, 1e-9);
    std::uniform_real_distribution<double> x(0, 12), y(0, 8);
    for (int i = 0; i < 300; ++i) {
      const Vector3d point(x(random), y(random), 0);
      const auto is_in = [&](const Ring& ring) {
        return IsInside(ProjectOutline(ring, kUp, Vector3d::Zero()), point.head<2>());
      };
      const bool is_seen = is_in(outline) && std::none_of(holes.begin(), holes.end(), is_in);
      EXPECT_EQ(Cover(all, *triangles, point), is_seen ? 1 : 0) << point.transpose();
    }
  }
}

TEST(TriangulateRings, WindsAboutTheNormalWhateverTheRingsDo) {
  for (const bool is_turned : {false, true}) {
    Ring outline = Box(0, 0, 4, 4), hole = Box(1, 1, 2, 2);
    if (is_turned) std::reverse(outline.begin(), outline.end());
    const Vector3d normal = is_turned ? Vector3d(-kUp) : kUp;
    const auto triangles = TriangulateRings(outline, {hole}, normal);
    ASSERT_TRUE(triangles);
    Ring all = outline;
    all.insert(all.end(), hole.begin(), hole.end());
    for (const Eigen::Vector3i& t : *triangles) {
      EXPECT_GT((all[t[1]] - all[t[0]]).cross(all[t[2]] - all[t[0]]).dot(normal), 0);
    }
  }
}

TEST(FaultOfRings, NamesTheHoleAtFault) {
  const Ring wall = Box(0, 0, 10, 4);
  EXPECT_EQ(FaultText(wall, {Box(1, 1, 1, 1), Box(3, 1, 1, 1)}), "");
  EXPECT_EQ(FaultText(wall, {Box(1, 1, 1, 1), Box(12, 1, 1, 1)}),
            "hole 2 is not inside the outline");
  EXPECT_EQ(FaultText(wall, {Box(9.5, 1, 1, 1)}), "hole 1 is not inside the outline");
  EXPECT_EQ(FaultText(wall, {Box(-1, -1, 12, 6)}), "hole 1 is not inside the outline");
  EXPECT_EQ(FaultText(wall, {Box(1, 0, 1, 2)}), "hole 1 is not inside the outline");  // touches
  EXPECT_EQ(FaultText(wall, {Box(1, 1, 1, 1), Box(1.5, 1.5, 1, 1)}), "hole 2 and hole 1 overlap");
  EXPECT_EQ(FaultText(wall, {Box(1, 1, 2, 2), Box(1.5, 1.5, 1, 1)}), "hole 2 and hole 1 overlap");
  EXPECT_EQ(FaultText(wall, {{{1, 1, 0}, {2, 2, 0}, {2, 1, 0}, {1, 2, 0}}}),
            "hole 1 crosses itself or has no area");
  EXPECT_EQ(FaultText({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}}, {}),
            "the outline crosses itself or has no area");
}

// Slits of 2 cm between nine bars.
TEST(FaultOfRings, HolesMayCrowd) {
  const Ring wall = Box(0, 0, 10, 10);
  std::vector<Ring> holes;
  for (int i = 0; i < 9; ++i) {
    holes.push_back(Box(0.5 + i, 0.001 + 0.1 * i, 0.98, 9 - 0.1 * i));
  }
  EXPECT_EQ(FaultText(wall, holes), "");
}

}  // namespace
}  // namespace insitu
