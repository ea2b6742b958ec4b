// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/examples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

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
    const Ray up{view.center, example_.site.zenith};
    EXPECT_FALSE(IsBlocked(building, up) || IsBlocked(example_.site.natural, up)) << view.photo;
  }
}

// What a mirror of the site shows in the photographs, on a grid of pixels, if it is even.
struct MirrorCount {
  int building = 0, natural = 0;
  int shaded = 0;  // where the building keeps the sun from the mirror
};

void CountAt(const Site& site, const Scene& building, const Ray& sight, const Hit& hit,
             MirrorCount* count) {
  const Vector3d& normal = hit.face->normal;
  const Vector3d at = sight.origin + hit.distance * sight.direction + kLift * normal;
  const Ray out{at, sight.direction - 2 * sight.direction.dot(normal) * normal};
  const auto natural = NearestHit(site.natural, out);
  const bool is_building = NearestHit(building, out, natural ? natural->distance : 1e9).has_value();
  count->building += is_building;
  count->natural += natural && !is_building;
  if (!site.has_sun) return;
  const Ray to_sun{at, site.sun};
  count->shaded += IsBlocked(building, to_sun) && !IsBlocked(site.blockers, to_sun);
}

MirrorCount CountMirrored(const SiteDescription& example, Material mirror) {
  constexpr int kStep = 8;  // [px]
  const Site& site = example.site;
  const Scene building = BuildingScene(example.building);
  MirrorCount count;
  for (const View& view : site.views) {
    const SightTable sights(view.lens);
    for (int y = 0; y < view.lens.height; y += kStep) {
      for (int x = 0; x < view.lens.width; x += kStep) {
        const Vector3d in_cam = sights.Tangents(Eigen::Vector2d(x, y)).homogeneous();
        const Ray sight{view.center, (view.cam_from_site.transpose() * in_cam).normalized()};
        const auto hit = NearestHit(site.natural, sight);
        if (!hit || hit->face->material != mirror) continue;
        if (IsBlocked(building, sight, hit->distance)) continue;
        CountAt(site, building, sight, *hit, &count);
      }
    }
  }
  return count;
}

INSTANTIATE_TEST_SUITE_P(Paper, EachExample, testing::ValuesIn(ExampleNames()));

TEST(Courtyard, HasNoSunAndNoHaze) {
  const SiteDescription courtyard = DescribeExample("courtyard", 720, 480);
  EXPECT_FALSE(courtyard.site.has_sun);
  EXPECT_TRUE((courtyard.daylight.sun_irradiance == 0).all());
  const Spectrum grey = Spectrum::Constant(0.3);
  EXPECT_LT((ThroughAir(courtyard.daylight, grey, 1000) - grey).abs().maxCoeff(), 1e-15);
}

// [Durisch92, Fig. 7]
TEST(Courtyard, MirrorsNaturalAndArtificialObjectsInItsPanes) {
  const MirrorCount panes = CountMirrored(DescribeExample("courtyard", 720, 480), Material::kPane);
  EXPECT_GT(panes.building, 20);
  EXPECT_GT(panes.natural, 20);
}

// [Durisch92, Fig. 6]
TEST(Bridge, ThrowsItsShadowAndItsReflectionOnTheWater) {
  const MirrorCount water = CountMirrored(DescribeExample("bridge", 720, 480), Material::kWater);
  EXPECT_GT(water.building, 500);
  EXPECT_GT(water.natural, 500);
  EXPECT_GT(water.shaded, 300);
}

TEST(Bridge, LiesOnTheOldSupports) {
  const SiteDescription bridge = DescribeExample("bridge", 720, 480);
  const Vector3d& up = bridge.site.zenith;
  const Scene building = BuildingScene(bridge.building);
  int supports = 0;
  for (const Face& face : bridge.site.natural.faces) {
    if (face.name != "pier0_w1" && face.name != "pier1_w1") continue;
    std::vector<Vector3d> corners = face.vertices;
    std::sort(corners.begin(), corners.end(),
              [&](const Vector3d& a, const Vector3d& b) { return a.dot(up) > b.dot(up); });
    constexpr double kBelow = 0.2;  // [m]
    const Vector3d top = (corners[0] + corners[1]) / 2;
    const auto hit = NearestHit(building, {top - kBelow * up, up});
    ASSERT_TRUE(hit) << face.name;
    // The bridge is drawn level, the site 0.3 degrees off: 4 cm at the supports.
    EXPECT_NEAR(hit->distance, kBelow, 0.05) << face.name;
    ++supports;
  }
  EXPECT_EQ(supports, 2);
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
