// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/examples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "datasets_synthetic/field_survey.h"
#include "datasets_synthetic/place.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

class EachExample : public testing::TestWithParam<std::string> {
 protected:
  const SiteDescription example_ = DescribeExample(GetParam(), 720, 480);
};

TEST_P(EachExample, HasThePapersPhotographs) {
  const std::map<std::string, size_t> photos = {{"gallery", 3}, {"bridge", 8}, {"courtyard", 9}};
  EXPECT_EQ(example_.site.views.size(), photos.at(GetParam()));
}

TEST_P(EachExample, HasPlanarPolygonsWithOneNameForOnePlace) {
  std::map<std::string, Vector3d> places;
  for (const Face& face : example_.site.natural.faces) {
    ASSERT_EQ(face.vertices.size(), face.vertex_names.size());
    for (size_t i = 0; i < face.vertices.size(); ++i) {
      EXPECT_LT(std::abs(face.normal.dot(face.vertices[i] - face.vertices[0])), 1e-9) << face.name;
      const auto place = places.try_emplace(face.vertex_names[i], face.vertices[i]).first->second;
      EXPECT_LT((place - face.vertices[i]).norm(), 1e-9) << face.vertex_names[i];
    }
  }
}

TEST_P(EachExample, ShowsEveryPhotographEnoughOfTheSurvey) {
  const FieldSurvey survey = SurveySite(example_.site);
  std::vector<int> marks(example_.site.views.size());
  for (const SurveyPoint& point : survey.points) {
    for (const Mark& mark : point.marks) ++marks[mark.view];
  }
  for (size_t i = 0; i < marks.size(); ++i) {
    EXPECT_GE(marks[i], 10) << example_.site.views[i].photo;
  }
  EXPECT_GE(survey.zenith_pairs.size(), 4u);
  EXPECT_EQ(survey.sun_pairs.empty(), !example_.site.has_sun);
}

TEST_P(EachExample, LeavesThePhotographersOutside) {
  for (const View& view : example_.site.views) {
    const Vector3d sight = view.cam_from_site.row(2);
    const Scene building = BuildingScene(example_.building);
    EXPECT_FALSE(IsBlocked(building, {view.center, sight}, 4)) << view.photo;
    EXPECT_FALSE(IsBlocked(example_.site.natural, {view.center, sight}, 4)) << view.photo;
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, EachExample, testing::ValuesIn(ExampleNames()));

TEST(Courtyard, HasNoSunAndNoHaze) {
  const SiteDescription courtyard = DescribeExample("courtyard", 720, 480);
  EXPECT_FALSE(courtyard.site.has_sun);
  EXPECT_TRUE((courtyard.daylight.sun_irradiance == 0).all());
  const Spectrum grey = Spectrum::Constant(0.3);
  EXPECT_LT((ThroughAir(courtyard.daylight, grey, 1000) - grey).abs().maxCoeff(), 1e-15);
}

TEST(Gallery, ThrowsASupportsShadowOnTheTorus) {
  const SiteDescription gallery = DescribeExample("gallery", 720, 480);
  const Scene building = BuildingScene(gallery.building);
  int shaded = 0, lit = 0;
  for (const Face& face : building.faces) {
    if (face.material != Material::kBluePaint || face.normal.dot(gallery.site.sun) < 0.2) continue;
    const Ray ray{face.center + kLift * face.normal, gallery.site.sun};
    const auto hit = NearestHit(gallery.site.blockers, ray);
    shaded += hit && hit->face->name.substr(0, 3) == "sup";
    lit += !hit;
  }
  EXPECT_GT(shaded, 20);
  EXPECT_GT(lit, 100);
}

}  // namespace
}  // namespace insitu::demo
