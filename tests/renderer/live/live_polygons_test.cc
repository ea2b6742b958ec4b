// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_polygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "renderer/live/live_solution.h"
#include "tests/reconstruction/survey/synthetic_network.h"
#include "tests/renderer/live/line_distance.h"

namespace insitu {
namespace {

constexpr double kOnLine = 0.6;  // [px]: lines bend by 0.25 px at most, and have two digits
constexpr double kEdgeOn =
    -0.2;  // a wall that looks away less: its seen side edge is near its foot

class LivePolygonsTest : public testing::Test {
 protected:
  LivePolygonsTest() : network_(MakeSyntheticNetwork()) { Solve(network_.survey); }

  void Solve(const Survey& survey) {
    LiveInput input;
    input.survey = survey;
    for (size_t i = 0; i < network_.photos.size(); ++i) {
      input.photos.push_back({network_.photos[i], network_.cameras[i]});
    }
    result_ = SolveLive(input);
  }

  Eigen::Vector3d Point(const std::string& name) const { return network_.points.at(name); }
  Eigen::Vector2d Pixel(size_t photo, const Eigen::Vector3d& point) const {
    return *network_.cameras[photo].Project(network_.cam_from_world[photo] * point);
  }
  const Json::Value& Lines(const std::string& polygon, const char* kind, size_t photo) const {
    return result_.message["polygons"][polygon][kind][network_.photos[photo]];
  }

  // Of a pixel from lines of a polygon; infinite: there are none.
  static double DistanceTo(const Json::Value& lines, const Eigen::Vector2d& pixel) {
    double least = std::numeric_limits<double>::infinity();
    for (const Json::Value& line : lines) least = std::min(least, DistanceToLine(line, pixel));
    return least;
  }

  // Cosine between a polygon's normal and the way to a photo; negative: it looks away.
  double Facing(const std::string& polygon, size_t photo) const {
    for (const Polygon& other : result_.scene->polygons) {
      if (other.name != polygon) continue;
      return other.normal.dot(
          (Center(network_.cam_from_world[photo]) - other.vertices[0]).normalized());
    }
    return 0;
  }

  SyntheticNetwork network_;
  LiveResult result_;
};

// The foot of a box's wall that looks away is behind the box; that of one which looks here is not,
// unless another box stands before it, which none does before all of them.
TEST_F(LivePolygonsTest, FeetOfWallsThatLookAwayAreHidden) {
  int away = 0, seen = 0;
  for (size_t photo = 0; photo < network_.photos.size(); ++photo) {
    for (const std::string box : {"a", "b", "c"}) {
      for (int wall = 0; wall < 4; ++wall) {
        const std::string name = box + "_wall" + std::to_string(wall);
        const Eigen::Vector3d foot =
            (Point(box + std::to_string(wall)) + Point(box + std::to_string((wall + 1) % 4))) / 2;
        const Eigen::Vector2d pixel = Pixel(photo, foot);
        if (!network_.cameras[photo].Sees(pixel)) continue;
        const bool is_seen = DistanceTo(Lines(name, "images", photo), pixel) < kOnLine;
        const bool is_hidden = DistanceTo(Lines(name, "hidden", photo), pixel) < kOnLine;
        const std::string what = name + " on " + network_.photos[photo];
        EXPECT_TRUE(is_seen || is_hidden) << what;
        const double facing = Facing(name, photo);
        if (facing > 0) {
          seen += is_seen && !is_hidden;
          continue;
        }
        EXPECT_TRUE(is_hidden) << what;
        EXPECT_FALSE(is_seen && facing < kEdgeOn) << what;
        ++away;
      }
    }
  }
  EXPECT_GT(away, 8);
  EXPECT_GT(seen, 8);
}

// What touches is not before: the top edge of a wall that looks here is an edge of its roof too.
TEST_F(LivePolygonsTest, SharedEdgesAreSeen) {
  int tried = 0;
  for (size_t photo = 0; photo < network_.photos.size(); ++photo) {
    if (Facing("b_wall0", photo) < 0) continue;
    const Eigen::Vector2d pixel = Pixel(photo, (Point("b4") + Point("b5")) / 2);
    if (!network_.cameras[photo].Sees(pixel)) continue;
    EXPECT_LT(DistanceTo(Lines("b_wall0", "images", photo), pixel), kOnLine);
    EXPECT_LT(DistanceTo(Lines("b_roof", "images", photo), pixel), kOnLine);
    ++tried;
  }
  EXPECT_GT(tried, 1);
}

// A hole in the ground where box c stands: its area is not counted, its outline is drawn, and the
// ground is not what a pixel within it shows.
TEST_F(LivePolygonsTest, HolesAreDrawnAndNotCounted) {
  const double whole = result_.message["polygons"]["ground"]["area_m2"].asDouble();
  Survey survey = network_.survey;
  survey.polygons[0].holes = {{"c0", "c3", "c2", "c1"}};
  Solve(survey);
  EXPECT_NEAR(result_.message["polygons"]["ground"]["area_m2"].asDouble(), whole - 28, 0.01);
  int tried = 0;
  for (size_t photo = 0; photo < network_.photos.size(); ++photo) {
    const Eigen::Vector2d pixel = Pixel(photo, (Point("c0") + Point("c1")) / 2);
    if (!network_.cameras[photo].Sees(pixel)) continue;
    const double seen = DistanceTo(Lines("ground", "images", photo), pixel);
    const double hidden = DistanceTo(Lines("ground", "hidden", photo), pixel);
    EXPECT_LT(std::min(seen, hidden), kOnLine) << photo;
    ++tried;
  }
  EXPECT_GT(tried, 1);
  const Polygon& ground = result_.scene->polygons[0];
  const std::vector<Polygon> alone = {ground};
  const Eigen::Vector2d within = Pixel(1, (Point("c0") + Point("c2")) / 2);
  EXPECT_FALSE(PolygonSeenAt(alone, result_.cameras[1], within));
  EXPECT_EQ(PolygonSeenAt(alone, result_.cameras[1], Pixel(1, Point("g4"))), 0u);
}

}  // namespace
}  // namespace insitu
