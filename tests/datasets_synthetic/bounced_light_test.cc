// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/bounced_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

// Surfaces here are of one colour and evenly lit.
constexpr BouncedLightOptions kCoarse = {1, 1, 8};

constexpr Material kGround = Material::kMetal, kWhite = Material::kPlaster,
                   kBlack = Material::kGlass;

Face FaceOf(const std::vector<Vector3d>& vertices, Material material) {
  Face face;
  face.vertices = vertices;
  face.material = material;
  return FinishFace(face);
}

Face Ground() {
  constexpr double kReach = 1e4;  // [m]
  return FaceOf(
      {{-kReach, -kReach, 0}, {kReach, -kReach, 0}, {kReach, kReach, 0}, {-kReach, kReach, 0}},
      kGround);
}

// In the plane x = 1, facing the origin.
Face Wall(Material material) {
  return FaceOf({{1, -5, 0}, {1, -5, 8}, {1, 5, 8}, {1, 5, 0}}, material);
}

struct World {
  Site site;
  Place place;
};

std::unique_ptr<World> MakeWorld(const std::vector<Face>& natural,
                                 const std::vector<Face>& building = {}) {
  auto world = std::make_unique<World>();
  world->site.zenith = Vector3d::UnitZ();
  world->site.sun = Vector3d(-0.5, 0, std::sqrt(0.75));
  world->site.natural = world->site.blockers = MakeScene(natural);
  world->place = {&world->site, MakeScene(building), ClearMorning()};
  return world;
}

Spectrum OpenGroundRadiance(const World& world) {
  const Daylight& light = world.place.daylight;
  return PlainReflectance(kGround) *
         (world.site.sun.z() / std::numbers::pi * light.sun_irradiance + light.sky_radiance);
}

void ExpectNear(const Spectrum& value, const Spectrum& expected, double tolerance) {
  EXPECT_LT((value - expected).abs().maxCoeff(), tolerance * expected.maxCoeff());
}

// What stands upright over endless ground sees it in half of its hemisphere.
TEST(BouncedLight, OfOpenGroundIsItsClosedFormOnAWall) {
  const auto world = MakeWorld({Ground()});
  const BouncedLight light(world->place, kCoarse);
  const Incoming at_wall = light.Gather({0, 0, 2}, Vector3d::UnitX(), 40, 1);
  ExpectNear(at_wall.before, 0.5 * OpenGroundRadiance(*world), 0.02);
  EXPECT_NEAR(at_wall.sky.before, 0.5, 0.01);
  EXPECT_TRUE((at_wall.before == at_wall.after).all());
}

// Endless ground under an endless ceiling, L_ground = a (E_g + L_ceiling), L_ceiling = b L_ground:
// with a sun that the ceiling cannot stop all bounces sum to a E_g / (1 - a b).
TEST(BouncedLight, BetweenPlatesIsAGeometricSeries) {
  auto world = MakeWorld({Ground()});
  const double reach = 1e4, height = 4;
  world->site.natural = MakeScene({Ground(), FaceOf({{-reach, -reach, height},
                                                     {-reach, reach, height},
                                                     {reach, reach, height},
                                                     {reach, -reach, height}},
                                                    kWhite)});
  const BouncedLight light(world->place, kCoarse);
  const Spectrum sun =
      world->site.sun.z() / std::numbers::pi * world->place.daylight.sun_irradiance;
  const Spectrum &a = PlainReflectance(kGround), &b = PlainReflectance(kWhite);
  const Spectrum ground = a * sun / (1 - a * b);
  ExpectNear(light.Gather({0, 0, 0.01}, Vector3d::UnitZ(), 20, 1).before, b * ground, 0.02);
  ExpectNear(light.Gather({0, 0, 3.99}, -Vector3d::UnitZ(), 20, 1).before, ground, 0.02);
}

TEST(BouncedLight, OfAWhiteWallComesToTheGroundBeforeIt) {
  const auto white = MakeWorld({Ground()}, {Wall(kWhite)});
  const auto black = MakeWorld({Ground()}, {Wall(kBlack)});
  const Vector3d place(0.5, 0, 0.001);
  const Incoming by_white =
      BouncedLight(white->place, kCoarse).Gather(place, Vector3d::UnitZ(), 20, 1);
  const Incoming by_black =
      BouncedLight(black->place, kCoarse).Gather(place, Vector3d::UnitZ(), 20, 1);
  EXPECT_EQ(by_white.sky.after, by_black.sky.after);
  EXPECT_LT(by_white.sky.after, by_white.sky.before);
  EXPECT_LT(by_white.before.maxCoeff(), 1e-12);
  EXPECT_GT(by_white.after.minCoeff(), 5 * by_black.after.maxCoeff());
}

}  // namespace
}  // namespace insitu::demo
