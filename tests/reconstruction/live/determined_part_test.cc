// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/live/determined_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/adjustment/find_start_values.h"
#include "reconstruction/adjustment/solve_survey.h"
#include "tests/reconstruction/survey/synthetic_network.h"
#include "tests/reconstruction/survey/synthetic_tie_points.h"

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;
using Kind = LeftOut::Kind;

class Part : public testing::Test {
 protected:
  DeterminedPart Find() const {
    return FindDeterminedPart(network_.survey, network_.photos, network_.cameras);
  }

  // All of it can be adjusted.
  static SolvedSurvey Solve(const DeterminedPart& part) {
    return SolveSurvey(part.survey, part.start, {}, {});
  }

  template <typename Predicate>
  void EraseMarks(const Predicate& predicate) {
    std::erase_if(network_.survey.observations, predicate);
  }

  static bool IsControl(const std::string& point) {
    return point[0] == 'g' || (point[0] == 'a' && point.size() == 2);
  }

  static std::vector<std::string> NamesOf(const DeterminedPart& part, Kind kind) {
    std::vector<std::string> names;
    for (const LeftOut& what : part.left_out) {
      if (what.kind == kind) names.push_back(what.name);
    }
    return names;
  }

  static const LeftOut& Of(const DeterminedPart& part, Kind kind, const std::string& name) {
    const auto found =
        std::find_if(part.left_out.begin(), part.left_out.end(),
                     [&](const LeftOut& what) { return what.kind == kind && what.name == name; });
    if (found == part.left_out.end()) throw std::runtime_error(name + " is not left out");
    return *found;
  }

  SyntheticNetwork network_ = MakeSyntheticNetwork({.has_extras = true});
};

void ExpectSameStart(const StartValues& a, const StartValues& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].cam_from_world.translation, b.cameras[i].cam_from_world.translation);
    EXPECT_EQ(a.cameras[i].cam_from_world.rotation.coeffs(),
              b.cameras[i].cam_from_world.rotation.coeffs());
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (const auto& [name, point] : a.points) {
    EXPECT_EQ(point.position, b.points.at(name).position) << name;
    EXPECT_EQ(point.sigma, b.points.at(name).sigma) << name;
  }
  EXPECT_EQ(a.tie_points.size(), b.tie_points.size());
}

TEST_F(Part, OfASoundSurveyIsTheWholeOfIt) {
  const DeterminedPart part = Find();
  EXPECT_THAT(part.left_out, IsEmpty());
  EXPECT_THAT(part.placed_by_points, IsEmpty());
  EXPECT_EQ(part.photos, network_.photos);
  EXPECT_THAT(part.indices, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(part.survey.observations.size(), network_.survey.observations.size());
  EXPECT_EQ(part.survey.polygons.size(), network_.survey.polygons.size());
  EXPECT_EQ(part.survey.edges.size(), network_.survey.edges.size());
  EXPECT_EQ(part.survey.constraints.size(), network_.survey.constraints.size());
  EXPECT_EQ(part.survey.camera_positions.size(), network_.survey.camera_positions.size());
  ExpectSameStart(part.start, FindStartValues(network_.survey, network_.photos, network_.cameras));
}

TEST_F(Part, WithTiePointsIsTheWholeToo) {
  network_ = MakeSyntheticNetwork();
  network_.survey.tie_points = ModelOf(network_, 30);
  const DeterminedPart part = Find();
  EXPECT_THAT(part.left_out, IsEmpty());
  ExpectSameStart(part.start, FindStartValues(network_.survey, network_.photos, network_.cameras));
}

TEST_F(Part, OfNothingIsEmpty) {
  network_.survey = {};
  const DeterminedPart part = Find();
  EXPECT_THAT(part.photos, IsEmpty());
  EXPECT_THAT(part.start.points, IsEmpty());
  EXPECT_THAT(NamesOf(part, Kind::kPhoto), ElementsAre("P1", "P2", "P3", "P4"));
  EXPECT_EQ(Of(part, Kind::kPhoto, "P1").reason.text(), "needs three control points");
  EXPECT_EQ(Of(part, Kind::kPhoto, "P1").place.path, "survey/observations.csv");
}

TEST_F(Part, OfControlAloneHasNoPhotos) {
  Survey survey;
  survey.control_points = network_.survey.control_points;
  network_.survey = survey;
  const DeterminedPart part = Find();
  EXPECT_THAT(part.photos, IsEmpty());
  EXPECT_EQ(part.survey.control_points.size(), survey.control_points.size());
  EXPECT_EQ(part.left_out.size(), 4u);
}

// Two control points and no others that two photos show.
TEST_F(Part, LeavesOutAPhotoWithTwoControlPoints) {
  EraseMarks([](const auto& mark) {
    return mark.photo == "P3" && mark.point != "a0" && mark.point != "g4";
  });
  const DeterminedPart part = Find();
  EXPECT_THAT(part.photos, ElementsAre("P1", "P2", "P4"));
  EXPECT_THAT(part.indices, ElementsAre(0, 1, 3));
  const LeftOut& photo = Of(part, Kind::kPhoto, "P3");
  EXPECT_EQ(photo.reason.text(), "needs one more control point");
  EXPECT_FALSE(photo.is_contradiction);
  const auto& marks = network_.survey.observations;
  EXPECT_EQ(photo.place.line, std::find_if(marks.begin(), marks.end(), [](const auto& mark) {
                                return mark.photo == "P3";
                              })->place.line);
  for (const ImageObservation& mark : part.survey.observations) EXPECT_NE(mark.photo, "P3");
  for (const EdgeMark& edge : part.survey.edges) EXPECT_NE(edge.photo, "P3");
  Solve(part);
}

TEST_F(Part, DoesNotPlaceAPhotoByCheckPointsAlone) {
  for (ControlPoint& point : network_.survey.control_points) point.role = ControlRole::kCheck;
  const DeterminedPart part = Find();
  EXPECT_THAT(part.photos, IsEmpty());
  EXPECT_EQ(Of(part, Kind::kPhoto, "P2").reason.text(), "needs three control points");
}

// P3 shows no control: points of the others place it, and "single", which P3 alone shows then, is
// determined by the ground.
TEST_F(Part, PlacesAPhotoThroughPointsOfOthers) {
  EraseMarks([](const auto& mark) { return mark.photo == "P3" && IsControl(mark.point); });
  const DeterminedPart part = Find();
  EXPECT_THAT(part.left_out, IsEmpty());
  EXPECT_THAT(part.placed_by_points, ElementsAre("P3"));
  EXPECT_LT(
      (Center(part.start.cameras[2].cam_from_world) - Center(network_.cam_from_world[2])).norm(),
      1e-3);
  EXPECT_THROW(FindStartValues(network_.survey, network_.photos, network_.cameras), InputError);
  EXPECT_LT(Solve(part).solution.square_sum, 1e-3);
}

// P3 by points of P1 and P2, P4 by those that P3 and P2 determine.
TEST_F(Part, PlacesAChainOfPhotos) {
  EraseMarks([](const auto& mark) {
    const char kind = mark.point[0];
    if (mark.photo == "P1") return kind == 'c';
    if (mark.photo == "P3") return IsControl(mark.point);
    return mark.photo == "P4" && kind != 'c';
  });
  const DeterminedPart part = Find();
  EXPECT_THAT(part.photos, ElementsAre("P1", "P2", "P3", "P4"));
  EXPECT_THAT(part.placed_by_points, ElementsAre("P3", "P4"));
  EXPECT_LT(Solve(part).solution.square_sum, 1e-3);
}

TEST_F(Part, KeepsAVertexOfOneRayOnAPlane) {
  const DeterminedPart whole = Find();
  EXPECT_TRUE(std::isinf(whole.start.points.at("single").sigma));

  // Without a fourth determined vertex the ground holds "single" no more, and "buried" goes with
  // it.
  auto& control = network_.survey.control_points;
  std::erase_if(control, [](const ControlPoint& point) { return point.name == "buried"; });
  const DeterminedPart part = Find();
  EXPECT_THAT(NamesOf(part, Kind::kPoint), UnorderedElementsAre("buried", "single"));
  EXPECT_EQ(Of(part, Kind::kPoint, "buried").reason.text(), "no ray, needs two photographs");
  EXPECT_EQ(Of(part, Kind::kPoint, "single").reason.text(), "one ray, needs a second photograph");
  EXPECT_EQ(Of(part, Kind::kPolygon, "ground").reason.text(),
            "its vertex buried is not determined");
  Solve(part);
}

TEST_F(Part, LeavesOutWhatNamesAnUndeterminedPoint) {
  EraseMarks([](const auto& mark) {
    return mark.point == "b4" && mark.photo != "P2";  // a check point: surveyed, but not observed
  });
  std::erase_if(network_.survey.polygons, [](const PolygonOutline& polygon) {
    return polygon.name == "b_roof" || polygon.name.rfind("b_wall", 0) == 0;
  });
  network_.survey.constraints.clear();
  const DeterminedPart part = Find();
  EXPECT_THAT(NamesOf(part, Kind::kPoint), ElementsAre("b4"));
  EXPECT_THAT(NamesOf(part, Kind::kPolygon), ElementsAre("sail"));
  EXPECT_EQ(Of(part, Kind::kPolygon, "sail").reason.text(), "its vertex b4 is not determined");
  EXPECT_THAT(NamesOf(part, Kind::kZenith), ElementsAre("b0 b4"));
  EXPECT_EQ(Of(part, Kind::kZenith, "b0 b4").place.path, "directions.json");
  Solve(part);
}

TEST_F(Part, LeavesOutConstraintsOfPolygonsThatGo) {
  EraseMarks([](const auto& mark) { return mark.point == "c6" || mark.point == "c7"; });
  const DeterminedPart part = Find();
  EXPECT_THAT(NamesOf(part, Kind::kPolygon), testing::Contains("c_roof"));
  std::set<std::string> polygons;
  for (const PolygonOutline& polygon : part.survey.polygons) polygons.insert(polygon.name);
  for (const GeometricConstraint& constraint : part.survey.constraints) {
    for (const std::string& name : constraint.polygons) EXPECT_TRUE(polygons.contains(name));
  }
  Solve(part);
}

TEST_F(Part, TellsContradictionsAndGoesOn) {
  Survey& survey = network_.survey;
  survey.observations.front().pixel.x() = -40;
  const std::string off = survey.observations.front().point;
  std::swap(survey.zenith_pairs.back().from, survey.zenith_pairs.back().to);
  const int line = survey.zenith_pairs.back().place.line;
  survey.polygons.push_back({"bent", {"a0", "a1", "b6", "c7"}, {}, "stone", {}, {"p.json", 99}});
  const DeterminedPart part = Find();
  ASSERT_EQ(part.left_out.size(), 3u);
  EXPECT_THAT(Of(part, Kind::kObservation, off).reason.text(), HasSubstr("outside the photograph"));
  EXPECT_THAT(Of(part, Kind::kPolygon, "bent").reason.text(),
              HasSubstr("'bent' is far from planar"));
  EXPECT_EQ(Of(part, Kind::kPolygon, "bent").reason.text().find("p.json"), std::string::npos);
  EXPECT_EQ(Of(part, Kind::kPolygon, "bent").place.line, 99);
  EXPECT_EQ(Of(part, Kind::kZenith, "c5 c1").place.line, line);
  for (const LeftOut& what : part.left_out) EXPECT_TRUE(what.is_contradiction) << what.name;
  EXPECT_LT(Solve(part).solution.square_sum, 1e-3);
}

TEST_F(Part, TellsAPhotoThatNoPlaceExplains) {
  // Its control points mirrored: no camera sees them so.
  for (ImageObservation& mark : network_.survey.observations) {
    if (mark.photo == "P2") mark.pixel.x() = 1799 - mark.pixel.x();
  }
  const DeterminedPart part = Find();
  Solve(part);  // placed badly or left out, but never thrown
}

// Long chains of planes, many photos: no quadratic search.
TEST_F(Part, TakesNLogN) {
  const auto seconds = [&](int copies) {
    SyntheticNetwork large = MakeSyntheticNetwork();
    const Survey one = large.survey;
    for (int copy = 1; copy < copies; ++copy) {
      const auto renamed = [&](const std::string& name) {
        return name + "_" + std::to_string(copy);
      };
      for (ImageObservation mark : one.observations) {
        mark.point = renamed(mark.point);
        large.survey.observations.push_back(mark);
      }
      for (PolygonOutline polygon : one.polygons) {
        polygon.name = renamed(polygon.name);
        for (std::string& vertex : polygon.vertices) vertex = renamed(vertex);
        large.survey.polygons.push_back(polygon);
      }
    }
    const auto start = std::chrono::steady_clock::now();
    FindDeterminedPart(large.survey, large.photos, large.cameras);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  seconds(10);
  const double few = seconds(20), many = seconds(160);
  EXPECT_LT(many, 8 * 3 * few + 0.05);  // quadratic would be 64
  RecordProperty("seconds", std::to_string(many));
}

}  // namespace
}  // namespace insitu
