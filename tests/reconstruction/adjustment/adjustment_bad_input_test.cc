// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "reconstruction/adjustment/adjust.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

class BadInput : public testing::Test {
 protected:
  void ExpectError(const std::string& file, int line, const std::string& subject) const {
    try {
      Adjust(network_.survey, network_.photos, network_.cameras);
      ADD_FAILURE() << "expected an error about " << subject;
    } catch (const InputError& error) {
      const std::string message = error.what();
      const std::string place = file + ":" + std::to_string(line) + ":";
      EXPECT_EQ(message.substr(0, place.size()), place) << message;
      EXPECT_NE(message.find(subject), std::string::npos) << message;
    }
  }

  template <typename Predicate>
  void EraseMarks(const Predicate& predicate) {
    std::erase_if(network_.survey.observations, predicate);
  }

  int LineOfMark(const std::string& photo, const std::string& point) const {
    const auto& marks = network_.survey.observations;
    return std::find_if(marks.begin(), marks.end(),
                        [&](const auto& mark) {
                          return mark.photo == photo && (point.empty() || mark.point == point);
                        })
        ->place.line;
  }

  PolygonOutline& PolygonNamed(const std::string& name) {
    auto& polygons = network_.survey.polygons;
    return *std::find_if(polygons.begin(), polygons.end(),
                         [&](const auto& polygon) { return polygon.name == name; });
  }

  static bool IsControl(const std::string& point) {
    return point[0] == 'g' || (point[0] == 'a' && point.size() == 2);
  }

  SyntheticNetwork network_ = MakeSyntheticNetwork();
};

TEST_F(BadInput, FewerThanThreeControlPointsOnAPhoto) {
  EraseMarks([](const auto& mark) {
    return mark.photo == "P3" && IsControl(mark.point) && mark.point != "a0" && mark.point != "g4";
  });
  ExpectError("observations.csv", LineOfMark("P3", ""), "photo 'P3' shows 2 control points");
}

TEST_F(BadInput, CheckPointsDoNotCountAsControl) {
  EraseMarks([](const auto& mark) {
    return mark.photo == "P3" && IsControl(mark.point) && mark.point != "a0" &&
           mark.point != "a6" && mark.point != "g4";
  });
  ASSERT_EQ(network_.survey.control_points.front().name, "a0");
  network_.survey.control_points.front().role = ControlRole::kCheck;
  ExpectError("observations.csv", LineOfMark("P3", ""), "photo 'P3' shows 2 control points");
}

TEST_F(BadInput, CollinearControl) {
  // g3, g4 and g5 stand in one row.
  EraseMarks([](const auto& mark) {
    return mark.photo == "P2" && IsControl(mark.point) && mark.point != "g3" &&
           mark.point != "g4" && mark.point != "g5";
  });
  ExpectError("observations.csv", LineOfMark("P2", "g3"), "photo 'P2' lie on one line");
}

TEST_F(BadInput, APhotoWithoutMarks) {
  EraseMarks([](const auto& mark) { return mark.photo == "P4"; });
  try {
    Adjust(network_.survey, network_.photos, network_.cameras);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("observations.csv: photo 'P4' shows 0 control"), 0u)
        << error.what();
  }
}

TEST_F(BadInput, AMarkOutsideItsPhotograph) {
  network_.survey.observations[6].pixel.x() = 1801;
  ExpectError("observations.csv", 8, "outside photo");
}

TEST_F(BadInput, AHoleThatIsNotInThePolygon) {
  PolygonOutline& ground = PolygonNamed("ground");
  std::erase(ground.vertices, "single");  // which the plane alone holds
  EraseMarks([](const auto& mark) { return mark.point == "single"; });
  ground.holes = {{"c4", "c5", "c6"}};  // twelve metres above
  ExpectError("polygons.json", ground.place.line, "far from planar: vertex '");
  ground.holes = {{"c0", "c2", "c1", "c3"}};
  ExpectError("polygons.json", ground.place.line, "hole 1 crosses itself");
  ground.holes = {{"b0", "b1", "b2"}, {"c0", "c1", "c2", "ghost"}};
  ExpectError("polygons.json", ground.place.line, "ghost");
  ground.holes = {{"b0", "b1", "b2"}};
  ground.vertices = {"c0", "c1", "c2", "c3"};
  ExpectError("polygons.json", ground.place.line,
              "polygon 'ground': hole 1 is not inside the outline");
}

TEST_F(BadInput, AVertexThatNothingDetermines) {
  PolygonNamed("c_roof").vertices.push_back("ghost");
  ExpectError("polygons.json", PolygonNamed("c_roof").place.line, "ghost");
}

TEST_F(BadInput, APointWithOneRayAndNoPolygon) {
  // The sail is a triangle: it takes its plane from its vertices and gives them nothing.
  PolygonNamed("sail").vertices[2] = "mast";
  network_.survey.observations.push_back(
      {"P1", "mast", {900, 600}, 0.4, {"observations.csv", 999}});
  ExpectError("observations.csv", 999, "mast");
}

TEST_F(BadInput, AControlPointUnderAnotherNameIsToldByItsPlace) {
  auto& control = network_.survey.control_points;
  const auto point = std::find_if(control.begin(), control.end(),
                                  [](const auto& each) { return each.name == "a6"; });
  point->name = "Q17";
  const auto warnings = Adjust(network_.survey, network_.photos, network_.cameras).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("control_points.csv:" + std::to_string(point->place.line) +
                             ": point 'Q17' is marked on no photo, and point 'a6', 0 mm from it"),
            0u)
      << warnings[0];
}

// Its name tells what it is, so its place need not.
TEST_F(BadInput, AControlPointUnderANearNameIsToldOnce) {
  auto& control = network_.survey.control_points;
  std::find_if(control.begin(), control.end(), [](const auto& each) {
    return each.name == "a6";
  })->name = "a6x";
  const auto warnings = Adjust(network_.survey, network_.photos, network_.cameras).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("did you mean 'a6'?"), std::string::npos) << warnings[0];
}

TEST_F(BadInput, ASurveyedPolygonFarFromPlanar) {
  auto& vertices = PolygonNamed("a_roof").vertices;
  std::replace(vertices.begin(), vertices.end(), std::string("a6"), std::string("a2"));
  ExpectError("polygons.json", PolygonNamed("a_roof").place.line, "far from planar");
}

TEST_F(BadInput, ACornerSurveyedFarFromWhereThePhotosShowIt) {
  // Its polygons are far from planar: the cause is told, not the symptom.
  for (ControlPoint& point : network_.survey.control_points) {
    if (point.name != "a6") continue;
    point.position += Vector3d(1.5, 1.5, 1.5);
    ExpectError("control_points.csv", point.place.line, "2.60 m from where photos");
  }
}

TEST_F(BadInput, AnIntersectedPolygonFarFromPlanar) {
  auto& vertices = PolygonNamed("b_roof").vertices;
  std::replace(vertices.begin(), vertices.end(), std::string("b6"), std::string("c6"));
  ExpectError("polygons.json", PolygonNamed("b_roof").place.line, "far from planar");
}

TEST_F(BadInput, APolygonThatCrossesItself) {
  auto& vertices = PolygonNamed("b_wall2").vertices;
  std::swap(vertices[1], vertices[2]);
  ExpectError("polygons.json", PolygonNamed("b_wall2").place.line, "crosses itself");
}

TEST_F(BadInput, APlaneThroughPointsOnOneLineIsARankDefectWithAName) {
  ControlPoint between = network_.survey.control_points.front();
  between.name = "between";
  between.position = (network_.points.at("g0") + 3 * network_.points.at("g1")) / 4;
  network_.survey.control_points.push_back(between);
  network_.survey.polygons.push_back(
      {"row", {"g0", "between", "g1", "g2"}, std::nullopt, "stone", {}, {"polygons.json", 99}});
  ExpectError("polygons.json", 99, "plane of polygon row normal");
}

TEST_F(BadInput, AnEdgeMarkedOutsideItsPhotograph) {
  network_.survey.edges.push_back({"P1", "g0", "g1", {-40, 10}, 1, {"edges.csv", 7}});
  ExpectError("edges.csv", 7, "edge 'g0' to 'g1' is marked outside photo 'P1'");
}

TEST_F(BadInput, ADistanceBetweenPointsInOnePlace) {
  ControlPoint twin = network_.survey.control_points.front();
  const std::string name = twin.name;
  twin.name = "twin";
  network_.survey.control_points.push_back(twin);
  network_.survey.constraints.push_back(
      {GeometricConstraint::Kind::kDistance, {}, {name, "twin"}, 1, 0.01, {"constraints.json", 5}});
  ExpectError("constraints.json", 5, "lie in the same place");
}

TEST_F(BadInput, AZenithPairUpsideDown) {
  DirectionPair& pair = network_.survey.zenith_pairs[3];
  std::swap(pair.from, pair.to);
  ExpectError("directions.json", pair.place.line, "points away");
}

TEST_F(BadInput, MarksThatNoPoseExplains) {
  for (ImageObservation& mark : network_.survey.observations) {
    if (mark.photo == "P1") mark.pixel = {900, 600};
  }
  ExpectError("observations.csv", LineOfMark("P1", "a0"), "photo 'P1' cannot be resected");
}

}  // namespace
}  // namespace insitu
