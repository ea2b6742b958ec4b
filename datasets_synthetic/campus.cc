// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/campus.h"

#include <cmath>
#include <numbers>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The sun over Bern on 2024-05-15 at 09:45 local time, as site.json says.
constexpr double kSunAzimuth = 102.33 * kDegree;
constexpr double kSunElevation = 37.19 * kDegree;

// A roof on six square supports on a floor slab, open on all sides.
std::vector<Face> Gallery(const Plan& plan) {
  const Vector2d center(-1.5, 6.5);
  const auto floor = BoxCorners("floor", {center, {13.4, 5.2}}, 0, 0.24);
  const auto roof = BoxCorners("roof", {center, {14.4, 6.2}}, 3.34, 3.72);
  std::vector<Face> faces;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 2; ++row) {
      const std::string name = "sup" + std::to_string(column) + std::to_string(row);
      const Vector2d at = center + Vector2d(5.9 * (column - 1), 3.9 * (row - 0.5));
      const auto corners = BoxCorners(name, {at, {0.46, 0.46}}, 0.24, 3.34);
      Append(faces, BoxFaces(plan, name, corners, 4, Material::kConcrete));
    }
  }
  Append(faces, BoxFaces(plan, "floor", floor, 5, Material::kConcrete));
  Append(faces, BoxFaces(plan, "roof", roof, 6, Material::kConcrete));
  return faces;
}

std::vector<NamedPoint> HouseCorners() {
  const Footprint walls{{11.6, 26.5}, {9.2, 7.4}, -14 * kDegree};
  const Footprint eaves{walls.center, {10.2, 8.6}, walls.turn};
  const Footprint ridge{walls.center, {walls.size.x(), 0}, walls.turn};
  const Footprint ridge_beam{walls.center, {eaves.size.x(), 0}, walls.turn};
  auto corners = BoxCorners("house", walls, 0, 5.2);
  const auto apexes = BoxCorners("house_apex", ridge, 7.98, 7.98);
  const auto edges = BoxCorners("house_eaves", eaves, 4.82, 4.82);
  const auto beams = BoxCorners("house_ridge", ridge_beam, 8.05, 8.05);
  for (const int i : {0, 1}) corners.push_back(apexes[i]);
  for (const int i : {0, 1, 2, 3}) corners.push_back(edges[i]);
  for (const int i : {0, 1}) corners.push_back(beams[i]);
  return corners;
}

// Brick walls s, e, n, w under a gable roof r0, r1 with eaves.
std::vector<Face> House(const Plan& plan) {
  const auto corners = HouseCorners();
  const WindowGrid front{3, 2, {1.2, 0.95}, {2.85, 2.35}, {1.1, 1.35}};
  const WindowGrid gable{2, 2, {1.35, 0.95}, {3.5, 2.35}, {1.1, 1.35}};
  return {
      plan.Polygon("house_s", corners, {0, 1, 5, 4}, Material::kBrick, front),
      plan.Polygon("house_e", corners, {1, 2, 6, 9, 5}, Material::kBrick, gable),
      plan.Polygon("house_n", corners, {2, 3, 7, 6}, Material::kBrick, front),
      plan.Polygon("house_w", corners, {3, 0, 4, 8, 7}, Material::kBrick, gable),
      plan.Polygon("house_r0", corners, {10, 11, 15, 14}, Material::kRoofTile),
      plan.Polygon("house_r1", corners, {12, 13, 14, 15}, Material::kRoofTile),
  };
}

// Blocks in the background; their far sides are nobody's concern.
std::vector<Face> Blocks(const Plan& plan, const std::vector<NamedPoint>& tower) {
  const auto block = BoxCorners("block", {{-29, 74}, {27, 12}, -24 * kDegree}, 0, 13.2);
  const WindowGrid block_front{7, 4, {1.9, 1.1}, {3.5, 3.1}, {2.1, 1.5}};
  const WindowGrid block_side{3, 4, {1.6, 1.1}, {3.5, 3.1}, {2.1, 1.5}};
  const WindowGrid tower_front{6, 13, {2.1, 1.3}, {3.2, 3.3}, {1.9, 1.7}};
  const WindowGrid tower_side{4, 13, {2.0, 1.3}, {3.2, 3.3}, {1.9, 1.7}};
  return {plan.Polygon("block_w0", block, {0, 1, 5, 4}, Material::kConcrete, block_front),
          plan.Polygon("block_w1", block, {1, 2, 6, 5}, Material::kConcrete, block_side),
          plan.Polygon("tower_w0", tower, {0, 1, 5, 4}, Material::kConcrete, tower_front),
          plan.Polygon("tower_w3", tower, {3, 0, 4, 7}, Material::kConcrete, tower_side)};
}

std::vector<NamedPoint> TargetsOnPlan() {
  const std::vector<Vector2d> places = {{-9.5, -4.6}, {-4.0, -7.5}, {1.6, -5.2}, {6.4, -3.4},
                                        {-16.0, 9.5}, {9.6, 11.0},  {-6.5, 1.9}};
  std::vector<NamedPoint> targets;
  for (const Vector2d& place : places) {
    const std::string name = std::string("target_") + std::to_string(targets.size() + 1);
    targets.emplace_back(name, Vector3d(place.x(), place.y(), 0));
  }
  return targets;
}

// Lawn to the foot of the tower, and a gravel path 15 mm above it.
std::vector<Face> Ground(const Plan& plan, const std::vector<NamedPoint>& tower,
                         const std::vector<NamedPoint>& site_targets) {
  const std::vector<NamedPoint> lawn = {{"lawn_0", {-60, -36, 0}},
                                        {"lawn_1", {60, -36, 0}},
                                        {"lawn_2", {150, 170, 0}},
                                        tower[1],
                                        tower[0],
                                        {"lawn_3", {-150, 170, 0}}};
  const std::vector<NamedPoint> path = {
      {"path_0", {-24.0, -4.6, 0.015}}, {"path_1", {-5.0, -1.1, 0.015}},
      {"path_2", {8.0, 0.1, 0.015}},    {"path_3", {26.0, 13.9, 0.015}},
      {"path_4", {25.0, 15.4, 0.015}},  {"path_5", {7.3, 1.85, 0.015}},
      {"path_6", {-5.2, 0.65, 0.015}},  {"path_7", {-24.4, -2.8, 0.015}}};
  Face grass = plan.Polygon("lawn", lawn, {0, 1, 2, 3, 4, 5}, Material::kGrass);
  for (const auto& [name, point] : site_targets) grass.targets.push_back(grass.Local(point));
  return {grass, plan.Polygon("path", path, {0, 1, 2, 3, 4, 5, 6, 7}, Material::kGravel)};
}

std::vector<Face> Lamp(const Plan& plan) {
  const auto corners = BoxCorners("lamp", {{-11.4, 0.9}, {0.16, 0.16}, 20 * kDegree}, 0, 5.1);
  return BoxFaces(plan, "lamp", corners, 4, Material::kMetal);
}

}  // namespace

Site MakeCampus(int width, int height, double azimuth) {
  Site site;
  site.record = {"demo", "2024-05-15T09:45:00+02:00", "sunny", 46.9538, 7.4452};
  site.survey.check_points = {"roof_1", "roof_7", "sup10_4", "sup21_1", "house_ridge_1", "path_6"};
  site.survey.upright_boxes = {"lamp", "house", "block", "tower", "sup00", "sup10", "sup20"};
  site.survey.level = site.survey.shadows = "lawn";
  site.origin = {2600507.0, 1200318.0, 431.5};
  site.azimuth = azimuth;
  const Eigen::AngleAxisd tilt(0.3 * kDegree, Vector3d(0.6, 0.8, 0));
  const Eigen::Matrix3d site_from_plan =
      (tilt * Eigen::AngleAxisd(site.azimuth, Vector3d::UnitZ())).toRotationMatrix();
  site.zenith = tilt * Vector3d::UnitZ();
  site.true_north = tilt * Vector3d::UnitY();
  site.sun =
      tilt * Vector3d(std::sin(kSunAzimuth) * std::cos(kSunElevation),
                      std::cos(kSunAzimuth) * std::cos(kSunElevation), std::sin(kSunElevation));
  for (const auto& [name, point] : TargetsOnPlan()) {
    site.targets.emplace_back(name, site_from_plan * point);
  }
  const Plan plan(site_from_plan);
  const auto tower = BoxCorners("tower", {{12, 243}, {22, 16}, 12 * kDegree}, 0, 46);
  std::vector<Face> faces;
  for (const auto& part : {Gallery(plan), House(plan), Lamp(plan), Blocks(plan, tower)}) {
    Append(faces, part);
  }
  site.blockers = MakeScene(faces);
  Append(faces, Ground(plan, tower, site.targets));
  site.natural = MakeScene(faces);
  site.scenery = MakeScene(Scenery(plan, -0.05, Material::kGrass));
  const Lens lens = DemoLens(width, height);
  site.views = {
      Photograph("left", lens, site_from_plan, {-12.6, -12.4, 1.65}, {-1.0, 9, 2.6}, 0.4 * kDegree),
      Photograph("middle", lens, site_from_plan, {0.6, -15.2, 1.70}, {-1.4, 9, 2.9},
                 -0.3 * kDegree),
      Photograph("right", lens, site_from_plan, {13.6, -10.6, 5.8}, {-3.6, 8, 2.0}, 0.6 * kDegree)};
  return site;
}

}  // namespace insitu::demo
