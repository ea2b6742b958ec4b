// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/polygon_measures.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "reconstruction/adjustment/adjust.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

// A 3 x 4 m rectangle far from the origin of coordinates.
struct Rectangle {
  Adjustment adjustment;
  PolygonOutline outline;

  Rectangle() {
    const Eigen::Vector3d corner(2600000, 1200000, 500);
    outline.name = "wall";
    outline.vertices = {"a", "b", "c", "d"};
    Polygon polygon;
    polygon.normal = Eigen::Vector3d::UnitZ();
    for (const auto& [x, y] :
         {std::pair(0, 0), std::pair(3, 0), std::pair(3, 4), std::pair(0, 4)}) {
      polygon.vertices.push_back(corner + Eigen::Vector3d(x, y, 0));
    }
    for (size_t i = 0; i < 4; ++i) {
      AdjustedPoint point;
      point.name = outline.vertices[i];
      point.position = polygon.vertices[i];
      point.covariance = 1e-4 * Eigen::Matrix3d::Identity();
      adjustment.points.push_back(point);
    }
    adjustment.scene.polygons = {polygon};
  }
};

TEST(MeasurePolygon, GivesAreaAndEdgesOfARectangle) {
  const Rectangle rectangle;
  const PolygonMeasures measures = MeasurePolygon(rectangle.adjustment, rectangle.outline, 0);
  EXPECT_NEAR(measures.area.value, 12, 1e-8);
  EXPECT_NEAR(measures.edges[0].value, 3, 1e-9);
  EXPECT_NEAR(measures.edges[1].value, 4, 1e-9);
  EXPECT_FALSE(measures.is_joint);
  // Independent ends of sigma 10 mm each; each vertex moves the area by half its diagonal, 2.5 m.
  EXPECT_NEAR(measures.edges[0].sigma, 0.01 * std::sqrt(2), 1e-9);
  EXPECT_NEAR(measures.area.sigma, 0.01 * 2.5 * 2, 1e-9);
}

TEST(MeasurePolygon, KnowsThatACommonShiftChangesNoLength) {
  Rectangle rectangle;
  rectangle.adjustment.scene.polygons[0].covariance =
      1e-4 * Eigen::Matrix3d::Identity().replicate(4, 4);  // all vertices move together
  const PolygonMeasures measures = MeasurePolygon(rectangle.adjustment, rectangle.outline, 0);
  EXPECT_TRUE(measures.is_joint);
  for (const UncertainValue& edge : measures.edges) EXPECT_NEAR(edge.sigma, 0, 1e-9);
  EXPECT_NEAR(measures.area.sigma, 0, 1e-9);
}

TEST(MeasurePolygon, TakesHolesOutWhicheverWayTheyTurn) {
  for (const bool is_reversed : {false, true}) {
    Rectangle rectangle;
    rectangle.outline.holes = {{"e", "f", "g"}};
    Polygon& polygon = rectangle.adjustment.scene.polygons[0];
    const Eigen::Vector3d& corner = polygon.vertices[0];
    polygon.holes = {{corner + Eigen::Vector3d(1, 1, 0), corner + Eigen::Vector3d(2, 1, 0),
                      corner + Eigen::Vector3d(2, 3, 0)}};
    if (is_reversed) std::swap(polygon.holes[0][1], polygon.holes[0][2]);
    for (size_t i = 0; i < 3; ++i) {
      AdjustedPoint point;
      point.name = rectangle.outline.holes[0][i];
      point.position = polygon.holes[0][i];
      point.covariance = 1e-4 * Eigen::Matrix3d::Identity();
      rectangle.adjustment.points.push_back(point);
    }
    const PolygonMeasures measures = MeasurePolygon(rectangle.adjustment, rectangle.outline, 0);
    EXPECT_NEAR(measures.area.value, 11, 1e-8);
    ASSERT_EQ(measures.edges.size(), 7u);
    EXPECT_NEAR(measures.edges[is_reversed ? 6 : 4].value, 1, 1e-9);
    // Half of the opposite side each, of the triangle 1, 2 and sqrt(5) m.
    EXPECT_NEAR(measures.area.sigma, 0.01 * std::sqrt(25 + (1 + 4 + 5) / 4.0), 1e-9);
  }
}

AdjustedPlane Plane(const Eigen::Vector3d& normal, double tangent_sigma) {
  AdjustedPlane plane;
  plane.normal = normal.normalized();
  plane.normal_covariance = tangent_sigma * tangent_sigma *
                            (Eigen::Matrix3d::Identity() - plane.normal * plane.normal.transpose());
  plane.tilt_covariance = plane.normal_covariance;  // the zenith is exact
  return plane;
}

TEST(AngleBetween, AddsTheTiltsOfBothPlanes) {
  const UncertainValue angle = AngleBetween(Plane({1, 0, 0}, 3e-3), Plane({0, 1, 0}, 4e-3));
  EXPECT_NEAR(angle.value, M_PI / 2, 1e-12);
  EXPECT_NEAR(angle.sigma, 5e-3, 1e-12);
}

TEST(OffLevel, IsTheNormalsAngleToTheZenithEitherWay) {
  const Eigen::Vector3d zenith = Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(OffLevel(Plane({0.01, 0, 1}, 2e-3), zenith).value, std::atan(0.01), 1e-12);
  EXPECT_NEAR(OffLevel(Plane({0.01, 0, -1}, 2e-3), zenith).value, std::atan(0.01), 1e-12);
  EXPECT_NEAR(OffLevel(Plane({0.01, 0, 1}, 2e-3), zenith).sigma, 2e-3, 1e-12);
  EXPECT_NEAR(OffLevel(Plane({0, 0, 1}, 2e-3), zenith).sigma, 2e-3, 1e-12);  // no direction at all
}

TEST(AdjoiningPolygons, ShareAnEdgeWhicheverWayItRuns) {
  Survey survey;
  for (const std::vector<std::string>& vertices :
       {std::vector<std::string>{"a", "b", "c", "d"}, {"b", "a", "e", "f"}, {"c", "g", "a", "h"}}) {
    PolygonOutline outline;
    outline.vertices = vertices;
    survey.polygons.push_back(outline);
  }
  const auto pairs = AdjoiningPolygons(survey);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0], (std::pair<size_t, size_t>(0, 1)));
}

TEST(PolygonCovariance, AgreesWithThePointsOwnAndMakesEdgesSurer) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Survey survey = WithNoise(network.survey, 3);
  const Adjustment adjustment = Adjust(survey, network.photos, network.cameras);
  ASSERT_EQ(adjustment.scene.polygons.size(), survey.polygons.size());
  std::map<std::string, Eigen::Matrix3d> own;
  for (const AdjustedPoint& point : adjustment.points) own[point.name] = point.covariance;
  for (size_t i = 0; i < survey.polygons.size(); ++i) {
    const Eigen::MatrixXd& joint = adjustment.scene.polygons[i].covariance;
    EXPECT_LT((joint - joint.transpose()).norm(), 1e-9 * joint.norm());
    for (size_t k = 0; k < survey.polygons[i].vertices.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(3 * k);
      const Eigen::Matrix3d& expected = own.at(survey.polygons[i].vertices[k]);
      EXPECT_LT((joint.block<3, 3>(at, at) - expected).norm(), 1e-9 * expected.norm());
    }
  }
}

}  // namespace
}  // namespace insitu
