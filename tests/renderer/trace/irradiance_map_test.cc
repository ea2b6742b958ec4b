// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/irradiance_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <thread>
#include <vector>

#include "renderer/trace/interreflected_light.h"
#include "tests/calibration/files/wrong_field.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

const SurfaceMaterial kGrey = {"grey", Eigen::Vector3d::Constant(0.4), 1, std::nullopt};

// A box on the lawn: triangles 0 and 1 are the lawn's, 0 to 11 the box's.
class IrradianceMapTest : public testing::Test {
 protected:
  IrradianceMapTest() {
    const SmallSite site = MakeSmallSite();
    scene_ = std::make_unique<MontageScene>(site.With(Box(site, {-2, -1, 0}, {2, 2, 3}, kGrey)));
    AddInterreflection(scene_.get(), std::nullopt);
  }

  const InterreflectedLight& Light() const { return *scene_->interreflected; }
  IrradianceMap Fresh(const IrradianceMapOptions& options = {}) const {
    return {Light().interreflection, scene_->artificial_mesh, scene_->artificial_normals, options};
  }

  SurfacePoint OnBox(const FacePlace& place) const {
    const Eigen::Vector3i& corners = scene_->artificial_mesh.triangles[place.triangle];
    const auto corner = [&](int i) -> Eigen::Vector3d {
      return scene_->artificial_mesh.vertices[corners[i]].cast<double>();
    };
    const Eigen::Vector2d& uv = place.uv;
    return {(1 - uv.sum()) * corner(0) + uv.x() * corner(1) + uv.y() * corner(2),
            scene_->artificial_normals[place.triangle]};
  }

  // Of every face but the one that the box stands on.
  std::vector<FacePlace> SomePlaces(int count = 200) const {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    std::vector<FacePlace> places;
    for (int i = 0; i < count; ++i) {
      Eigen::Vector2d uv(uniform(random), uniform(random));
      if (uv.sum() > 1) uv = Eigen::Vector2d::Ones() - uv;
      places.push_back({2 + i % 10, uv});
    }
    return places;
  }

  std::unique_ptr<MontageScene> scene_;
};

double Largest(const Spectrum& spectrum) { return spectrum.abs().maxCoeff(); }

bool AreSame(const SmoothLight& a, const SmoothLight& b) {
  return (a.before == b.before).all() && (a.change == b.change).all() && a.matters == b.matters;
}

double RelativeError(const SmoothLight& smooth, const GatheredLight& exact) {
  const Spectrum after = exact.sky_before + exact.surroundings_before + exact.change;
  return ((smooth.before + smooth.change) / after - 1).abs().maxCoeff();
}

TEST_F(IrradianceMapTest, FollowsTheGatheredLight) {
  const IrradianceMap map = Fresh();
  double sum = 0;
  const std::vector<FacePlace> places = SomePlaces();
  for (const FacePlace& place : places) {
    const double error = RelativeError(map.At(place), Light().interreflection.At(OnBox(place)));
    EXPECT_LT(error, 0.04) << OnBox(place).position.transpose();  // single directions come and go
    sum += error;
  }
  EXPECT_LT(sum / static_cast<double>(places.size()), IrradianceMapOptions().tolerance);
}

TEST_F(IrradianceMapTest, IsFinerWithLessTolerance) {
  const IrradianceMap coarse = Fresh({.tolerance = 0.2, .calm = 4}), fine = Fresh();
  for (const FacePlace& place : SomePlaces()) {
    coarse.At(place);
    fine.At(place);
  }
  EXPECT_GE(coarse.points(), 8);
  EXPECT_GT(fine.points(), coarse.points());
}

TEST_F(IrradianceMapTest, IsAFunctionOfThePlaceAlone) {
  const IrradianceMap map = Fresh(), other = Fresh();
  std::vector<FacePlace> places = SomePlaces();
  std::vector<SmoothLight> first;
  for (const FacePlace& place : places) first.push_back(map.At(place));
  const long points = map.points();
  for (size_t i = places.size(); i-- > 0;) {
    EXPECT_TRUE(AreSame(map.At(places[i]), first[i]));
    EXPECT_TRUE(AreSame(other.At(places[i]), first[i]));  // asked in another order
  }
  EXPECT_EQ(map.points(), points);
}

TEST_F(IrradianceMapTest, IsTheSameFromManyThreads) {
  const IrradianceMap map = Fresh(), shared = Fresh();
  const std::vector<FacePlace> places = SomePlaces();
  std::vector<std::vector<SmoothLight>> found(4);
  std::vector<std::thread> threads;
  for (size_t t = 0; t < found.size(); ++t) {
    threads.emplace_back([&, t] {
      for (const FacePlace& place : places) found[t].push_back(shared.At(place));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < places.size(); ++i) {
    for (const std::vector<SmoothLight>& one : found) {
      EXPECT_TRUE(AreSame(one[i], map.At(places[i])));
    }
  }
}

// A box whose walls go up through a plate that juts out over them: what is under it is dark, the
// walls' upper corners are not.
ArtificialEnvironment BoxThroughEaves(const SmallSite& site) {
  ArtificialEnvironment house = Box(site, {-2, -1, 0}, {2, 2, 3}, kGrey);
  const ArtificialEnvironment eaves = Plate(site, {0, 0.5, 2.9}, 2.3, kGrey);
  const Eigen::Vector3i first = Eigen::Vector3i::Constant(static_cast<int>(house.vertices.size()));
  house.vertices.insert(house.vertices.end(), eaves.vertices.begin(), eaves.vertices.end());
  for (const Eigen::Vector3i& triangle : eaves.triangles) {
    house.triangles.push_back(first + triangle);
  }
  house.material_of_triangle.resize(house.triangles.size(), 0);
  return house;
}

TEST_F(IrradianceMapTest, CornersBeyondEavesDoNotShowBelowThem) {
  const SmallSite site = MakeSmallSite();
  scene_ = std::make_unique<MontageScene>(site.With(BoxThroughEaves(site)));
  AddInterreflection(scene_.get(), std::nullopt);
  const IrradianceMap map = Fresh({.calm = 1});
  int places = 0;
  for (const FacePlace& place : SomePlaces(3000)) {
    const SurfacePoint point = OnBox(place);
    if (point.normal.z() > 0.5 || point.position.z() < 1 || point.position.z() > 2.85) continue;
    const GatheredLight exact = Light().interreflection.At(point);
    EXPECT_LT(RelativeError(map.At(place), exact), 0.05) << point.position.transpose();
    ++places;
  }
  EXPECT_GT(places, 1000);
}

// Normals of a plane's triangles differ in their last bits: whichever is asked for first, all is
// the same to the bit, or a render that goes on where it was stopped would end with other bytes.
TEST_F(IrradianceMapTest, DoesNotDependOnWhatIsAskedForFirst) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment turned = Box(site, {-2, -1, 0}, {2, 2, 3}, kGrey);
  const Eigen::AngleAxisd turn(0.3, Eigen::Vector3d(0.02, 0.05, 1).normalized());
  const Eigen::Vector3d& origin = site.natural.scene.origin;
  for (Eigen::Vector3d& vertex : turned.vertices) vertex = origin + turn * (vertex - origin);
  scene_ = std::make_unique<MontageScene>(site.With(turned));
  AddInterreflection(scene_.get(), std::nullopt);
  const IrradianceMap forward = Fresh(), backward = Fresh();
  std::vector<FacePlace> places = SomePlaces();
  std::vector<SmoothLight> found;
  for (const FacePlace& place : places) found.push_back(forward.At(place));
  for (size_t i = places.size(); i-- > 0;) {
    EXPECT_TRUE(AreSame(backward.At(places[i]), found[i])) << i;
  }
}

// The two triangles of a face meet on its diagonal, from corner 0 to corner 2 of the one, 0 to 1 of
// the other.
TEST_F(IrradianceMapTest, HasNoSeamBetweenTrianglesOfAPlane) {
  const IrradianceMap map = Fresh();
  for (int face = 1; face < 6; ++face) {
    for (const double along : {0.0, 0.21, 0.5, 0.83, 1.0}) {
      const FacePlace a{2 * face, {0, along}}, b{2 * face + 1, {along, 0}};
      ASSERT_LT((OnBox(a).position - OnBox(b).position).norm(), 1e-6);
      const SmoothLight at_a = map.At(a), at_b = map.At(b);
      const Spectrum sum_a = at_a.before + at_a.change, sum_b = at_b.before + at_b.change;
      EXPECT_LT((sum_a / sum_b - 1).abs().maxCoeff(), 0.02) << face << ' ' << along;
    }
    const FacePlace a{2 * face, {0, 0}}, b{2 * face + 1, {0, 0}};
    EXPECT_TRUE((map.At(a).before == map.At(b).before).all()) << face;  // a shared corner
  }
}

TEST_F(IrradianceMapTest, FarLawnIsBeyondReach) {
  const IrradianceMap& map = Light().on_site;
  const auto lawn = [&](double x, double y) {  // triangle 0: corners (-100, -100), (100, -100), ...
    for (int t = 0; t < 2; ++t) {
      const auto corner = [&](int i) {
        return scene_->natural_mesh.vertices[scene_->natural_mesh.triangles[t][i]].cast<double>();
      };
      Eigen::Matrix2d edges;
      edges << (corner(1) - corner(0)).head<2>(), (corner(2) - corner(0)).head<2>();
      const Eigen::Vector2d uv = edges.inverse() * (Eigen::Vector2d(x, y) - corner(0).head<2>());
      if (uv.minCoeff() >= 0 && uv.sum() <= 1) return map.At({t, uv});
    }
    return SmoothLight{};
  };
  EXPECT_TRUE(lawn(3, 0.1).matters);
  EXPECT_FALSE(lawn(95, -94).matters);
}

TEST(IrradianceMapOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(IrradianceMapOptions()), "");
  EXPECT_NE(WrongField(IrradianceMapOptions{.tolerance = 0}).find("tolerance"), std::string::npos);
  EXPECT_NE(WrongField(IrradianceMapOptions{.smallest = -1}).find("smallest"), std::string::npos);
  EXPECT_NE(WrongField(IrradianceMapOptions{.calm = 0.001}).find("calm"), std::string::npos);
  EXPECT_NE(WrongField(IrradianceMapOptions{.reach = -1}).find("reach"), std::string::npos);
}

TEST_F(IrradianceMapTest, PartsAddUpToTheLight) {
  for (const bool is_site : {false, true}) {
    const IrradianceMap& map = is_site ? Light().on_site : Light().on_building;
    for (FacePlace place : SomePlaces(50)) {
      if (is_site) place.triangle %= 2;
      const SmoothLight light = map.At(place);
      const GatheredParts parts = map.PartsAt(place);
      const double unit = Largest(light.before) + 1e-9;
      EXPECT_LT(Largest(parts.sky + parts.surroundings - light.before - light.change), 1e-9 * unit);
      EXPECT_LT(
          Largest(parts.bounced - parts.sky_blocked - parts.surroundings_blocked - light.change),
          1e-9 * unit);
      EXPECT_GE(parts.sky_blocked.minCoeff(), 0);
      EXPECT_GE(parts.surroundings_blocked.minCoeff(), 0);
    }
  }
}

}  // namespace
}  // namespace insitu
