// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/campus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "datasets_synthetic/field_survey.h"
#include "datasets_synthetic/pavilion.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

const SurveyPoint& PointNamed(const FieldSurvey& survey, const std::string& name) {
  for (const SurveyPoint& point : survey.points) {
    if (point.name == name) return point;
  }
  throw std::out_of_range(name);
}

TEST(Campus, HasPlanarPolygonsWithOneNameForOnePlace) {
  const Site site = MakeCampus(960, 640);
  std::map<std::string, Vector3d> places;
  std::set<std::string> names;
  for (const Face& face : site.natural.faces) {
    EXPECT_TRUE(names.insert(face.name).second) << face.name;
    ASSERT_EQ(face.vertices.size(), face.vertex_names.size());
    for (size_t i = 0; i < face.vertices.size(); ++i) {
      EXPECT_NEAR(face.normal.dot(face.vertices[i] - face.vertices[0]), 0, 1e-9) << face.name;
      const Vector3d place =
          places.try_emplace(face.vertex_names[i], face.vertices[i]).first->second;
      EXPECT_LT((place - face.vertices[i]).norm(), 1e-9) << face.vertex_names[i];
    }
  }
}

TEST(Campus, TiltsTheZenithAndKeepsTheSunWhereTheAlmanacPutsIt) {
  const Site site = MakeCampus(960, 640);
  const double degree = std::numbers::pi / 180;
  EXPECT_NEAR(std::acos(site.zenith.z()) / degree, 0.3, 1e-9);
  EXPECT_NEAR(std::asin(site.sun.dot(site.zenith)) / degree, 37.19, 1e-9);
  EXPECT_NEAR(site.true_north.dot(site.zenith), 0, 1e-15);
  const Vector3d east = site.true_north.cross(site.zenith);
  const double azimuth = std::atan2(site.sun.dot(east), site.sun.dot(site.true_north));
  EXPECT_NEAR(azimuth / degree, 102.33, 1e-9);
}

TEST(Campus, PhotographersStandUprightFifteenToThirtyMetresAway) {
  for (const View& view : MakeCampus(960, 640).views) {
    EXPECT_GT(view.center.norm(), 12);
    EXPECT_LT(view.center.norm(), 30);
    EXPECT_NEAR(view.cam_from_site.determinant(), 1, 1e-12);
    EXPECT_GT((view.cam_from_site * Vector3d(0, 0, -1)).y(), 0.9);  // y points down
  }
}

TEST(Survey, LeavesNoPointUndetermined) {
  const FieldSurvey survey = SurveySite(MakeCampus(960, 640));
  int control = 0, check = 0;
  for (const SurveyPoint& point : survey.points) {
    EXPECT_TRUE(point.role == PointRole::kControl || point.marks.size() >= 2) << point.name;
    control += point.role == PointRole::kControl;
    check += point.role == PointRole::kCheck;
  }
  EXPECT_GE(control, 20);
  EXPECT_GE(check, 4);
  EXPECT_LE(check, 6);
}

TEST(Survey, PairsPointAlongSunAndZenith) {
  const Site site = MakeCampus(960, 640);
  const FieldSurvey survey = SurveySite(site);
  EXPECT_GE(survey.sun_pairs.size(), 3u);
  EXPECT_GE(survey.zenith_pairs.size(), 5u);
  for (const auto& [object, shadow] : survey.sun_pairs) {
    const Vector3d along =
        PointNamed(survey, object).position - PointNamed(survey, shadow).position;
    EXPECT_GT(along.normalized().dot(site.sun), 1 - 1e-12) << object;
    EXPECT_GE(PointNamed(survey, shadow).marks.size(), 2u) << shadow;
  }
  for (const auto& [bottom, top] : survey.zenith_pairs) {
    const Vector3d along = PointNamed(survey, top).position - PointNamed(survey, bottom).position;
    EXPECT_GT(along.normalized().dot(site.zenith), 1 - 1e-12) << bottom;
  }
}

// The back of the gallery's floor slab is behind the slab itself for the man in the middle.
TEST(Survey, MarksOnlyWhatIsVisible) {
  const Site site = MakeCampus(960, 640);
  const FieldSurvey survey = SurveySite(site);
  const View& middle = site.views[1];
  EXPECT_TRUE(Shows(site, middle, PointNamed(survey, "floor_0").position));
  EXPECT_FALSE(Shows(site, middle, PointNamed(survey, "floor_2").position));
  EXPECT_FALSE(Shows(site, middle, middle.center - middle.cam_from_site.row(2).transpose()));
}

// The divergence theorem; positive only if every face looks outwards.
double Volume(const std::vector<std::vector<Vector3d>>& faces) {
  double volume = 0;
  for (const auto& face : faces) {
    for (size_t i = 1; i + 1 < face.size(); ++i) {
      volume += face[0].dot(face[i].cross(face[i + 1])) / 6;
    }
  }
  return volume;
}

TEST(Pavilion, IsClosedAndFacesOutwards) {
  const Building pavilion = MakePavilion(0.3);
  std::vector<std::vector<Vector3d>> boxes, triangles;
  for (const Panel& panel : pavilion.panels) boxes.push_back(panel.corners);
  EXPECT_NEAR(Volume(boxes), 9.6 * 6.2 * 6.2 + 11.0 * 7.6 * 0.35, 1e-9);
  const Polyhedron& ball = pavilion.bodies[0];
  for (const Eigen::Vector3i& t : ball.triangles) {
    triangles.push_back({ball.vertices[t[0]], ball.vertices[t[1]], ball.vertices[t[2]]});
  }
  const double sphere = 4 * std::numbers::pi / 3 * std::pow(1.05, 3);
  EXPECT_LT(Volume(triangles), sphere);
  EXPECT_GT(Volume(triangles), 0.85 * sphere);
}

// The glass must look away from the wall that it hangs on.
TEST(Pavilion, HangsItsPanesOutsideTheWalls) {
  const Building pavilion = MakePavilion(0.3);
  Vector3d middle = Vector3d::Zero();
  for (const Placement& window : pavilion.windows) {
    middle += window.position / static_cast<double>(pavilion.windows.size());
  }
  int panes = 0;
  for (const Face& face : BuildingScene(pavilion).faces) {
    if (face.material != Material::kGlass) continue;
    EXPECT_GT(face.normal.dot(face.center - middle), 1);
    ++panes;
  }
  EXPECT_EQ(panes, static_cast<int>(pavilion.windows.size()));
}

}  // namespace
}  // namespace insitu::demo
