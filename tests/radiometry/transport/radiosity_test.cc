// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of light among surfaces with a planned building in it.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "radiometry/transport/interreflection.h"
#include "tests/radiometry/transport/court.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ(), kEast = Eigen::Vector3d::UnitX();

// Enough that 1 % of a form factor is many of them.
constexpr int kMany = 16384;

PatchGrid Grid(double half, double size) {
  const Eigen::Vector3d low(-half, -half, 0), high(half, half, half);
  return {{Eigen::AlignedBox3d(low, high)}, size};
}

std::vector<SurfacePoint> PointsOfCourt() {
  std::vector<SurfacePoint> points;
  for (const double x : {-4.5, -2.0, 0.3, 3.1}) {
    points.push_back({Eigen::Vector3d(x, -3.2, 0), kUp});
    points.push_back({Eigen::Vector3d(-5, x, 1.7), kEast});
    points.push_back({Eigen::Vector3d(x, 5, 3.3), -Eigen::Vector3d::UnitY()});
  }
  return points;
}

// Form factors from an element to a rectangle of `a` by `b`, a corner of which lies on its normal
// (parallel) or at the foot of the perpendicular (standing); `c` apart. [Howell, B-3, B-4]
double FactorToParallel(double a, double b, double c) {
  const double x = a / c, y = b / c, p = std::hypot(1, x), q = std::hypot(1, y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi);
}
double FactorToStanding(double height, double width, double c) {
  const double x = height / width, y = c / width, r = std::hypot(x, y);
  return (std::atan(1 / y) - y / r * std::atan(1 / r)) / (2 * kPi);
}

TEST(Radiosity, ParallelPlateHasItsFormFactor) {
  Court court;
  court.AddWall("plate", {-2, -3, 4}, {0, 6, 0}, {4, 0, 0}, 0.4);  // looks down
  court.Photograph({0, 0, 1});
  const TransportScene scene = court.Scene();
  Interreflection light(scene, court.UnderSky(0), Grid(3, 0.25), {.point_directions = kMany});
  light.Solve(court.UnderSky(0));
  const double c = 4 - kSurveyClearance;
  const GatheredLight there = light.At({Eigen::Vector3d::Zero(), kUp});
  const double expected = kPi * 0.4 * 4 * FactorToParallel(2, 3, c);
  EXPECT_NEAR(court.Red(there.surroundings_before), expected, 0.01 * expected);
}

TEST(Radiosity, StandingPlateHasItsFormFactor) {
  Court court;
  court.AddWall("wall", {2, -3, 0}, {0, 0, 4}, {0, 6, 0}, 0.4);  // looks west
  court.Photograph({0, 0, 1});
  const TransportScene scene = court.Scene();
  Interreflection light(scene, court.UnderSky(0), Grid(3, 0.25), {.point_directions = kMany});
  light.Solve(court.UnderSky(0));
  // From the clearance above the foot: the strip below the element's plane does not count.
  const GatheredLight there = light.At({Eigen::Vector3d(0, 0, -kSurveyClearance), kUp});
  const double expected = kPi * 0.4 * 2 * FactorToStanding(4, 3, 2);
  EXPECT_NEAR(court.Red(there.surroundings_before), expected, 0.01 * expected);
}

// Between wide plates, one of them lit: E_1 = E_0 / (1 - r_1 r_2), E_2 = r_1 E_1.
TEST(Radiosity, TwoWidePlannedPlatesSendLightToAndFro) {
  Court court;
  court.AddPlanned({-12, -12, 1}, {24, 0, 0}, {0, 24, 0}, 0.6);    // looks up
  court.AddPlanned({-12, -12, 1.5}, {0, 24, 0}, {24, 0, 0}, 0.5);  // looks down
  court.Photograph({0, 0, 1.2});
  const auto lamps = [&](const SurfacePoint& point) -> Spectrum {
    const bool is_lit = point.position.z() < 1.2 && point.normal.z() > 0;
    return is_lit ? court.Grey(1) : Spectrum::Zero().eval();
  };
  const TransportScene scene = court.Scene(lamps);
  Interreflection light(scene, court.UnderSky(0), Grid(12, 0.4));
  light.Solve(court.UnderSky(0));
  const double E_1 = 1 / (1 - 0.6 * 0.5), E_2 = 0.6 * E_1;
  const GatheredLight above = light.At({Eigen::Vector3d(0.1, 0.2, 1.5), -kUp});
  EXPECT_NEAR(court.Red(above.change), E_2, 0.01 * E_2);
  const GatheredLight below = light.At({Eigen::Vector3d(0.1, 0.2, 1), kUp});
  EXPECT_NEAR(court.Red(below.change), E_1 - 1, 0.01 * E_1);  // the lamp's own is left out
}

// A wide plate over lit ground of reflectance r_n = L / sky, which it cuts off from the sky:
// E_n = E_0 / (1 - r_n r_p), E_p = r_n E_n. The ground's change counts for the plate and back.
TEST(Radiosity, PlannedPlateAndPhotographedGroundSendLightToAndFro) {
  Court court;
  court.AddWall("ground", {-12, -12, 0}, {24, 0, 0}, {0, 24, 0}, 0.2);
  court.AddPlanned({-12, -12, 0.5}, {0, 24, 0}, {24, 0, 0}, 0.5);  // looks down
  court.Photograph({0, 0, 10});
  const auto lamps = [&](const SurfacePoint& point) -> Spectrum {
    const bool is_ground = point.position.z() < 0.2 && point.normal.z() > 0;
    return is_ground ? court.Grey(1) : Spectrum::Zero().eval();
  };
  const TransportScene scene = court.Scene(lamps);
  const Daylight sky = court.UnderSky(0.5);
  Interreflection light(scene, sky, Grid(12, 0.4));
  light.Solve(sky);
  const GatheredLight plate = light.At({Eigen::Vector3d(0.1, 0.2, 0.5), -kUp});
  const double E_p = 0.4 / (1 - 0.4 * 0.5);
  EXPECT_NEAR(court.Red(plate.surroundings_before + plate.change), E_p, 0.01);
}

// In a closed cube whose every face is lit by the same lamps, E = E_0 / (1 - r).
TEST(Radiosity, ClosedPlannedCubeMultipliesItsLight) {
  for (const double albedo : {0.2, 0.5, 0.8}) {
    Court court;
    court.AddPlannedBox({-1, -1, 1}, {1, 1, 3}, albedo);
    court.Photograph({0, 0, 5});
    const TransportScene scene = court.Scene([&](const SurfacePoint&) { return court.Grey(1); });
    const Daylight sky = court.UnderSky(0.3);
    Interreflection light(scene, sky, Grid(1, 0.25));
    light.Solve(sky);
    const double expected = 1 / (1 - albedo);
    for (const double x : {-0.7, 0.1}) {
      const GatheredLight there = light.At({Eigen::Vector3d(x, 0.2, 1), kUp});
      EXPECT_NEAR(court.Red(there.sky_before + there.change), expected - 1, 0.01 * expected);
      EXPECT_EQ(there.inside, 1);
    }
  }
}

// A room in a solid: the backs of its outer faces look the same way as the inner faces that share
// their pieces, but lie in the dark of the wall.
TEST(Radiosity, WallsThinnerThanAPieceKeepTheirRoomsLight) {
  Court court;
  court.AddPlannedBox({-2, -2, 1}, {2, 2, 5}, 0.5);
  court.AddPlannedBox({1.85, 1.85, 4.85}, {-1.85, -1.85, 1.15}, 0.5);  // inwards
  court.Photograph({0, 0, 7});
  const auto lamps = [&](const SurfacePoint& point) -> Spectrum {
    const Eigen::Vector3d before = point.position + 0.1 * point.normal - Eigen::Vector3d(0, 0, 3);
    return before.cwiseAbs().maxCoeff() < 1.86 ? court.Grey(1) : Spectrum::Zero().eval();
  };
  const TransportScene scene = court.Scene(lamps);
  const Daylight sky = court.UnderSky(0.3);
  Interreflection light(
      scene, sky,
      {{Eigen::AlignedBox3d(Eigen::Vector3d(-2, -2, 1), Eigen::Vector3d(2, 2, 5))}, 0.5});
  light.Solve(sky);
  for (const double x : {-1.2, 0.1}) {
    const GatheredLight there = light.At({Eigen::Vector3d(x, 0.2, 1.15), kUp});
    EXPECT_NEAR(court.Red(there.sky_before + there.change), 1, 0.02);
    EXPECT_EQ(there.inside, 0);
  }
}

TEST(Radiosity, FurnaceAWhiteBuildingInAWhiteCourtDisappears) {
  Court court;
  court.AddOpenBox(5, 8, 0.4);
  court.AddPlannedBox({-1.87, -0.91, 0}, {2.13, 2.2, 4}, 1);
  court.Photograph({-4, -4, 6});
  const TransportScene scene = court.Scene();
  const Daylight sky = court.UnderSky(0.4);
  Interreflection light(scene, sky, Grid(5, 0.5));
  light.Solve(sky);
  std::vector<SurfacePoint> points = PointsOfCourt();
  points.push_back({Eigen::Vector3d(-1.87, 0.5, 2), -kEast});
  points.push_back({Eigen::Vector3d(0, 0, 4), kUp});
  for (const SurfacePoint& point : points) {
    const GatheredLight there = light.At(point);
    EXPECT_EQ(there.unseen, 0);
    const double before = court.Red(there.sky_before + there.surroundings_before);
    EXPECT_NEAR(before, kPi * 0.4, 1e-3 * kPi * 0.4);
    EXPECT_LT(std::abs(court.Red(there.change)), 0.005 * before) << point.position.transpose();
  }
}

TEST(Radiosity, ABlackBuildingOnlyRemoves) {
  Court court;
  court.AddOpenBox(5, 4, 0.2);
  court.AddPlannedBox({-2, -1, 0}, {2, 2, 3}, 0);
  court.Photograph({-4, -4, 3});
  const TransportScene scene = court.Scene();
  const Daylight sky = court.UnderSky(0.5);
  Interreflection light(scene, sky, Grid(5, 0.5));
  light.Solve(sky);
  for (const SurfacePoint& point : PointsOfCourt()) {
    const GatheredLight there = light.At(point);
    EXPECT_TRUE((there.change < 0).all()) << point.position.transpose();
    EXPECT_TRUE((there.sky_before + there.surroundings_before + there.change >= 0).all());
  }
}

// A plate below the ground blocks nothing; its lamps light the court, whose walls send it on.
TEST(Radiosity, LampsThatBlockNothingOnlyAdd) {
  for (const bool has_plate : {true, false}) {
    Court court;
    court.AddOpenBox(5, 4, 0.2);
    if (has_plate) court.AddPlanned({-1, -1, -2}, {2, 0, 0}, {0, 2, 0}, 0.5);
    court.Photograph({-4, -4, 3});
    const TransportScene scene = court.Scene([&](const SurfacePoint&) { return court.Grey(0.1); });
    const Daylight sky = court.UnderSky(0.5);
    Interreflection light(scene, sky, Grid(5, 0.5));
    light.Solve(sky);
    for (const SurfacePoint& point : PointsOfCourt()) {
      EXPECT_GT(court.Red(light.At(point).change), 0.001) << point.position.transpose();
    }
  }
}

TEST(Radiosity, WithoutBouncesABuildingTakesTheSkyItHides) {
  Court court;
  court.AddWall("ground", {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0.2);
  court.AddPlanned({-2, -3, 4}, {0, 6, 0}, {4, 0, 0}, 0.5);
  court.Photograph({-6, -6, 3});
  const TransportScene scene = court.Scene();
  const Daylight sky = court.UnderSky(0.5);
  Interreflection light(scene, sky, Grid(5, 0.5), {.bounces = 0, .point_directions = kMany});
  light.Solve(sky);
  const GatheredLight there = light.At({Eigen::Vector3d::Zero(), kUp});
  const double hidden = kPi * 0.5 * 4 * FactorToParallel(2, 3, 4 - kSurveyClearance);
  EXPECT_NEAR(court.Red(there.change), -hidden, 0.01 * hidden);
  // What the ground reflects is told by its photograph all the same, but for its edge.
  EXPECT_NEAR(court.Red(light.MeanBrdf(0) * kPi * sky.sky_radiance), 0.2, 0.05 * 0.2);
}

// The sky is spread as the light says: a wall receives less of an overcast one, and what hides the
// zenith takes more than its form factor.
TEST(Radiosity, AnOvercastSkyIsBrightestOnTop) {
  Court court;
  court.AddWall("ground", {-50, -50, -3}, {100, 0, 0}, {0, 100, 0}, 0.2);
  court.AddPlanned({-0.5, -0.5, 4}, {0, 1, 0}, {1, 0, 0}, 0);
  court.Photograph({-6, -6, 3});
  const TransportScene scene = court.Scene();
  Daylight sky = court.UnderSky(0.5);
  sky.sky_shape.gradation.setOnes();
  Interreflection light(scene, sky, Grid(5, 0.5), {.bounces = 0, .point_directions = kMany});
  light.Solve(sky);
  const GatheredLight level = light.At({Eigen::Vector3d::Zero(), kUp});
  EXPECT_NEAR(court.Red(level.sky_before), kPi * 0.5, 0.005 * kPi * 0.5);
  const double hidden = kPi * 0.5 * 4 * FactorToParallel(0.5, 0.5, 4 - kSurveyClearance);
  EXPECT_NEAR(court.Red(level.change), -9.0 / 7 * hidden, 0.02 * hidden);
  const GatheredLight wall = light.At({Eigen::Vector3d(0, 0, -1), kEast});
  const double share = (kPi / 6 + 4.0 / 9) / (7 * kPi / 9);
  EXPECT_NEAR(court.Red(wall.sky_before), share * kPi * 0.5, 0.01 * kPi * 0.5);
  EXPECT_NEAR(court.Red(wall.relative_sky * court.Grey(1)), 2 * share, 0.02);
}

// Each bounce more adds light: none is a black building, one the sky's and the photographed
// surroundings' light on it.
TEST(Radiosity, BouncesConverge) {
  Court court;
  court.AddOpenBox(5, 4, 0.3);
  court.AddPlannedBox({-2, -1, 0}, {2, 2, 3}, 0.6);
  court.Photograph({-4, -4, 3});
  const TransportScene scene = court.Scene();
  const Daylight sky = court.UnderSky(0.5);
  const auto change = [&](std::optional<int> bounces) {
    Interreflection light(scene, sky, Grid(5, 0.5), {.bounces = bounces});
    light.Solve(sky);
    return court.Red(light.At({Eigen::Vector3d(-4, 0.4, 0), kUp}).change);
  };
  const double all = change(std::nullopt);
  EXPECT_GT(std::abs(change(1) - all), std::abs(change(2) - all));
  EXPECT_NEAR(change(12), all, 1e-3);
}

TEST(Radiosity, IsTheSameWithAnyNumberOfThreads) {
  Court court;
  court.AddOpenBox(5, 4, 0.3);
  court.AddPlannedBox({-2, -1, 0}, {2, 2, 3}, 0.6);
  court.Photograph({-4, -4, 3});
  const TransportScene scene = court.Scene();
  const Daylight sky = court.UnderSky(0.5);
  const auto solve = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Interreflection light(scene, sky, Grid(5, 0.5));
    light.Solve(sky);
    std::vector<GatheredLight> all;
    for (const SurfacePoint& point : PointsOfCourt()) all.push_back(light.At(point));
    return all;
  };
  const std::vector<GatheredLight> one = solve(1), four = solve(4);
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_TRUE((one[i].change == four[i].change).all());
    EXPECT_TRUE((one[i].surroundings_before == four[i].surroundings_before).all());
    EXPECT_EQ(one[i].nearness, four[i].nearness);
  }
}

}  // namespace
}  // namespace insitu
