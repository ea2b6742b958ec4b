// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/bridge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "datasets_synthetic/ray_cast.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRiverAzimuth = 31 * kDegree;
constexpr double kBank = 24;      // [m], half the river's width
constexpr double kQuay = 1.5;     // [m], banks above the water
constexpr double kPierTop = 4.1;  // [m]
constexpr double kPier = 9;       // [m], from the middle of the river

// The sun over Bueren an der Aare on 2024-05-15 at 11:00 local time.
constexpr double kRiverSunAzimuth = 120.56 * kDegree, kRiverSunElevation = 48.97 * kDegree;
constexpr double kSunOnPlan = 232 * kDegree;  // counter-clockwise from the plan's x axis

std::vector<Face> RiverHouse(const Plan& plan) {
  auto corners = BoxCorners("house", {{-34, 10}, {11, 9}}, kQuay, 9.2);
  corners.emplace_back("house_eaves_0", Vector3d(-40, 4.6, 9.0));
  corners.emplace_back("house_eaves_1", Vector3d(-28, 4.6, 9.0));
  corners.emplace_back("house_ridge_0", Vector3d(-40, 10, 12.4));
  corners.emplace_back("house_ridge_1", Vector3d(-28, 10, 12.4));
  const WindowGrid front{4, 3, {1.0, 0.9}, {2.6, 2.5}, {1.1, 1.5}};
  std::vector<Face> faces = {
      plan.Polygon("house_w0", corners, {0, 1, 5, 4}, Material::kPalePlaster, front),
      plan.Polygon("house_w1", corners, {1, 2, 6, 5}, Material::kPalePlaster),
      plan.Polygon("house_roof", corners, {8, 9, 11, 10}, Material::kRoofTile)};
  for (const int floor : {0, 1}) {
    const std::string name = "balcony" + std::to_string(floor);
    const double bottom = 3.95 + 2.5 * floor;
    const auto balcony = BoxCorners(name, {{-34, 4.9}, {8, 1.2}}, bottom, bottom + 1.0);
    Append(faces, {plan.Polygon(name + "_w0", balcony, {0, 1, 5, 4}, Material::kBoards),
                   plan.Polygon(name + "_w1", balcony, {1, 2, 6, 5}, Material::kBoards),
                   plan.Polygon(name + "_bot", balcony, {3, 2, 1, 0}, Material::kBoards)});
  }
  return faces;
}

// Three sides of each support of the bridge that burnt, and a post on the bank.
std::vector<Face> Supports(const Plan& plan) {
  std::vector<Face> faces;
  for (const int side : {0, 1}) {
    const std::string name = "pier" + std::to_string(side);
    const auto corners = BoxCorners(name, {{side ? kPier : -kPier, 0}, {2.2, 6.4}}, 0, kPierTop);
    for (const Face& face : BoxFaces(plan, name, corners, 4, Material::kConcrete)) {
      if (face.name != name + "_w2") faces.push_back(face);
    }
  }
  const auto post = BoxCorners("post", {{-29, -21}, {0.3, 0.3}, 0.3}, kQuay, 6.5);
  Append(faces, BoxFaces(plan, "post", post, 4, Material::kMetal));
  return faces;
}

// Either bank, and the quay below it. `side` is -1 on the left, 1 on the right.
std::vector<Face> Bank(const Plan& plan, const std::string& name, double side) {
  const double near = -40, far = 240;
  const std::vector<NamedPoint> corners = {
      {name + "_0", {side * kBank, near, 0}},    {name + "_1", {side * kBank, far, 0}},
      {name + "_2", {side * kBank, far, kQuay}}, {name + "_3", {side * kBank, near, kQuay}},
      {name + "_4", {side * 90, far, kQuay}},    {name + "_5", {side * 90, near, kQuay}}};
  const bool left = side < 0;
  return {plan.Polygon(name + "_quay", corners,
                       left ? std::vector<int>{0, 1, 2, 3} : std::vector<int>{1, 0, 3, 2},
                       Material::kGravel),
          plan.Polygon(name, corners,
                       left ? std::vector<int>{3, 2, 4, 5} : std::vector<int>{2, 3, 5, 4},
                       Material::kGrass)};
}

// Ground level of the banks, with targets along both.
std::vector<NamedPoint> TargetsOnBanks() {
  const std::vector<Vector2d> places = {{-26, -14}, {-27.5, -5}, {-25.6, 3}, {-26.5, 24},
                                        {26, -12},  {27.5, -2},  {25.8, 8},  {27, 26}};
  std::vector<NamedPoint> targets;
  for (const Vector2d& place : places) {
    targets.emplace_back("target_" + std::to_string(targets.size() + 1),
                         Vector3d(place.x(), place.y(), kQuay));
  }
  return targets;
}

// Drawn on plan: a covered bridge of timber, bay by bay, its deck on the old supports.
Building CoveredBridge() {
  constexpr double kEnd = 27, kHalf = 2.4, kDeck = 4.55, kPlate = 7.4;  // [m]
  constexpr int kBays = 18;
  Building bridge;
  bridge.layers = {Material::kBridgeTimber, Material::kBridgeRoof, Material::kSandstone};
  std::vector<Panel>& panels = bridge.panels;
  const Material timber = Material::kBridgeTimber;
  for (const double side : {-1.0, 1.0}) {  // abutments on either bank
    AddBox(panels, {std::min(side * kEnd, side * (kBank + 0.2)), -kHalf - 0.3, 1.2},
           {std::max(side * kEnd, side * (kBank + 0.2)), kHalf + 0.3, kPierTop - 0.05},
           Material::kSandstone);
  }
  constexpr double kEaves = 3.3, kLow = 7.35, kRidge = 9.6;  // [m], of the roof
  constexpr double kBay = 2 * kEnd / kBays;
  for (int i = 0; i < kBays; ++i) {
    const double x0 = -kEnd + i * kBay, x1 = x0 + kBay;
    AddBox(panels, {x0, -kHalf, kPierTop}, {x1, kHalf, kDeck}, timber);
    for (const double y : {-kHalf, kHalf - 0.25}) {
      AddBox(panels, {x0, y, kPlate}, {x1, y + 0.25, kPlate + 0.35}, timber);
      AddBox(panels, {x0, y + 0.08, kDeck + 0.15}, {x1, y + 0.18, kDeck + 1.1}, timber);
      AddBox(panels, {x0 + 0.02, y, kDeck}, {x0 + 0.27, y + 0.25, kPlate}, timber);
    }
    panels.push_back(Quad({x0, -kEaves, kLow}, {x1, -kEaves, kLow}, {x1, 0, kRidge},
                          {x0, 0, kRidge}, Material::kBridgeRoof));
    panels.push_back(Quad({x0, 0, kRidge}, {x1, 0, kRidge}, {x1, kEaves, kLow}, {x0, kEaves, kLow},
                          Material::kBridgeRoof));
  }
  return bridge;
}

std::vector<Stand> RiverStands() {
  return {{{-14, -44, 3.2}, {-13, 0, 3.0}}, {{0, -46, 3.4}, {-2, 0, 3.0}},
          {{12, -44, 3.2}, {-7, 0, 3.0}},   {{20, -43, 3.1}, {-10, 0, 3.0}},
          {{-27, -33, 3.2}, {-2, 0, 2.6}},  {{27, -30, 3.2}, {-8, 0, 2.8}},
          {{6, -47, 9.5}, {-9, 0, 2.0}},    {{26.5, -18, 3.2}, {-14, 2, 3.0}}};
}

Site MakeRiver(int width, int height) {
  Site site;
  site.record = {"bridge", "2024-05-15T11:00:00+02:00", "sunny", 47.1386, 7.3722};
  site.survey.check_points = {"house_5", "pier0_5", "pier1_4", "balcony1_4"};
  site.survey.control_points = {"house_1", "house_4", "pier0_0", "pier0_1", "pier0_4", "pier1_0",
                                "pier1_1", "pier1_5", "post_4",  "right_3", "left_3"};
  site.survey.upright_boxes = {"house", "pier0", "pier1", "post"};
  site.survey.level = "water";
  site.survey.matt = {"left", "right"};
  site.survey.shadows = "left";
  site.survey.daylight = Material::kPalePlaster;
  site.origin = {2593210.0, 1220640.0, 428.0};
  site.azimuth = kRiverAzimuth;
  site.waves = {0.06, 3.0, 0.2, 7};
  const Eigen::AngleAxisd tilt(0.3 * kDegree, Vector3d(0.8, -0.6, 0));
  const Eigen::Matrix3d site_from_plan =
      (tilt * Eigen::AngleAxisd(kRiverAzimuth, Vector3d::UnitZ())).toRotationMatrix();
  const auto level = [&](double angle) {
    return Vector3d(site_from_plan * Vector3d(std::cos(angle), std::sin(angle), 0));
  };
  site.zenith = tilt * Vector3d::UnitZ();
  site.sun =
      std::cos(kRiverSunElevation) * level(kSunOnPlan) + std::sin(kRiverSunElevation) * site.zenith;
  site.true_north = level(kSunOnPlan + kRiverSunAzimuth);
  for (const auto& [name, point] : TargetsOnBanks()) {
    site.targets.emplace_back(name, site_from_plan * point);
  }
  const Plan plan(site_from_plan);
  std::vector<Face> faces = RiverHouse(plan);
  Append(faces, Supports(plan));
  site.blockers = MakeScene(faces);
  for (const auto& [name, side] : {std::pair<const char*, double>{"left", -1}, {"right", 1}}) {
    for (Face& face : Bank(plan, name, side)) {
      for (const auto& [target, point] : site.targets) {
        const bool lies_on = face.name == name && Contains(face.outline, face.Local(point));
        if (lies_on) face.targets.push_back(face.Local(point));
      }
      faces.push_back(face);
    }
  }
  const std::vector<NamedPoint> river = {{"left_0", {-kBank, -40, 0}},
                                         {"right_0", {kBank, -40, 0}},
                                         {"right_1", {kBank, 240, 0}},
                                         {"left_1", {-kBank, 240, 0}}};
  faces.push_back(plan.Polygon("water", river, {0, 1, 2, 3}, Material::kWater));
  site.natural = MakeScene(faces);
  site.scenery = MakeScene(Scenery(plan, -0.05, Material::kGrass));
  site.views = Photographs("river_", RiverStands(), DemoLens(width, height), site_from_plan);
  return site;
}

}  // namespace

SiteDescription DescribeBridge(int width, int height) {
  return {MakeRiver(width, height), Turned(CoveredBridge(), kRiverAzimuth), ClearMorning()};
}

}  // namespace insitu::demo
