// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/courtyard.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kYardAzimuth = 24 * kDegree;

// The white house in the corner: two walls and a roof that rises to the back.
std::vector<Face> WhiteHouse(const Plan& plan) {
  auto corners = BoxCorners("white", {{-9.5, 11}, {11, 4}}, 0, 8.6);
  corners.emplace_back("white_ridge_0", Vector3d(-15, 15, 11.2));
  corners.emplace_back("white_ridge_1", Vector3d(-4, 15, 11.2));
  const WindowGrid front{4, 2, {1.2, 3.9}, {2.5, 2.5}, {1.1, 1.5}};
  return {plan.Polygon("white_w0", corners, {0, 1, 5, 4}, Material::kWhitePlaster, front),
          plan.Polygon("white_w1", corners, {1, 2, 6, 5}, Material::kWhitePlaster),
          plan.Polygon("white_roof", corners, {4, 5, 9, 8}, Material::kRoofTile)};
}

// A wall from `left` to `right` as seen from the yard, and the roof above it.
std::vector<Face> Row(const Plan& plan, const std::string& name, const Vector2d& left,
                      const Vector2d& right, double eaves, const WindowGrid& windows) {
  const Vector2d along = (right - left).normalized();
  const Vector2d back = 4 * Vector2d(-along.y(), along.x());
  const auto at = [](const Vector2d& p, double z) { return Vector3d(p.x(), p.y(), z); };
  const std::vector<NamedPoint> corners = {{name + "_0", at(left, 0)},
                                           {name + "_1", at(right, 0)},
                                           {name + "_4", at(left, eaves)},
                                           {name + "_5", at(right, eaves)},
                                           {name + "_8", at(left + back, eaves + 2.6)},
                                           {name + "_9", at(right + back, eaves + 2.6)}};
  return {plan.Polygon(name + "_wall", corners, {0, 1, 3, 2}, Material::kStucco, windows),
          plan.Polygon(name + "_roof", corners, {2, 3, 5, 4}, Material::kRoofTile)};
}

// A shop's pane, 3 cm before the wall that it hangs on.
Face Pane(const Plan& plan, const std::string& name, const Vector2d& left, const Vector2d& right) {
  const Vector2d along = (right - left).normalized();
  const Vector2d out = 0.03 * Vector2d(along.y(), -along.x());
  const auto at = [&out](const Vector2d& p, double z) {
    return Vector3d(p.x() + out.x(), p.y() + out.y(), z);
  };
  const std::vector<NamedPoint> corners = {{name + "_0", at(left, 0.5)},
                                           {name + "_1", at(right, 0.5)},
                                           {name + "_2", at(right, 3.1)},
                                           {name + "_3", at(left, 3.1)}};
  return plan.Polygon(name, corners, {0, 1, 2, 3}, Material::kPane);
}

std::vector<Face> Houses(const Plan& plan) {
  const WindowGrid back{6, 2, {1.3, 4.2}, {3.0, 3.0}, {1.2, 1.7}};
  const WindowGrid right{8, 2, {1.4, 4.2}, {3.1, 2.9}, {1.2, 1.6}};
  const WindowGrid left{7, 1, {1.3, 4.0}, {3.0, 3.0}, {1.2, 1.6}};
  std::vector<Face> faces = WhiteHouse(plan);
  Append(faces, Row(plan, "back", {-4, 13}, {15, 13}, 10.4, back));
  Append(faces, Row(plan, "right", {15, 13}, {15, -13}, 9.6, right));
  Append(faces, Row(plan, "left", {-15, -13}, {-15, 9}, 6.6, left));
  Append(faces, BoxFaces(plan, "wall", BoxCorners("wall", {{0, -13.2}, {30, 0.4}}, 0, 2.2), 3,
                         Material::kConcrete));
  faces.erase(faces.end() - 3, faces.end() - 1);  // only its back faces the yard
  const auto shed = BoxCorners("shed", {{12.2, 10.5}, {5.6, 5}}, 0, 2.8);
  Append(faces, {plan.Polygon("shed_w0", shed, {0, 1, 5, 4}, Material::kBoards),
                 plan.Polygon("shed_w3", shed, {3, 0, 4, 7}, Material::kBoards),
                 plan.Polygon("shed_top", shed, {4, 5, 6, 7}, Material::kMetal)});
  Append(faces,
         {Pane(plan, "shop_0", {-2.6, 13}, {1.2, 13}), Pane(plan, "shop_1", {2.6, 13}, {6.4, 13}),
          Pane(plan, "shop_2", {15, 1.5}, {15, -3.5})});
  return faces;
}

std::vector<NamedPoint> TargetsOnPaving() {
  const std::vector<Vector2d> places = {{-11, -7}, {-5.5, -8.5}, {1, -7.5},   {7.5, -8}, {12, -4},
                                        {-12, 3},  {-6.5, 6.5},  {11.5, 5.5}, {1.5, -3}};
  std::vector<NamedPoint> targets;
  for (const Vector2d& place : places) {
    targets.emplace_back("target_" + std::to_string(targets.size() + 1),
                         Vector3d(place.x(), place.y(), 0));
  }
  return targets;
}

// One bay of an arcade between `x0` and `x1`: a wall from `front` to `back`, up to `top`, over an
// arch of a half circle that springs at `spring`.
void AddArch(std::vector<Panel>& panels, double x0, double x1, double front, double back,
             double spring, double top) {
  constexpr int kSteps = 10;
  const double radius = (x1 - x0) / 2, middle = (x0 + x1) / 2;
  const auto on_arch = [&](int i) {
    const double turn = std::numbers::pi * (1 - static_cast<double>(i) / kSteps);
    return Vector2d(middle + radius * std::cos(turn), spring + radius * std::sin(turn));
  };
  for (int i = 0; i < kSteps; ++i) {
    const Vector2d a = on_arch(i), b = on_arch(i + 1);
    panels.push_back(Quad({a.x(), front, a.y()}, {b.x(), front, b.y()}, {b.x(), front, top},
                          {a.x(), front, top}, Material::kPlaster));
    panels.push_back(Quad({b.x(), back, b.y()}, {a.x(), back, a.y()}, {a.x(), back, top},
                          {b.x(), back, top}, Material::kPlaster));
    panels.push_back(Quad({a.x(), back, a.y()}, {b.x(), back, b.y()}, {b.x(), front, b.y()},
                          {a.x(), front, a.y()}, Material::kPlaster));
  }
}

// Drawn on plan: an arcade of four bays in front, two storeys over it.
Building ArcadeHouse() {
  constexpr double kLeft = -3, kRight = 7, kFront = 1, kBack = 7, kCeiling = 3.4, kEaves = 8.4;
  constexpr double kArcade = 2.6, kPillar = 0.5;  // [m], depth, width
  constexpr int kBays = 4;
  Building house;
  house.layers = {Material::kPlaster, Material::kSlate, Material::kTimber, Material::kGlass};
  AddBox(house.panels, {kLeft, kFront + kArcade, -0.3}, {kRight, kBack, kCeiling},
         Material::kPlaster);
  AddBox(house.panels, {kLeft, kFront, kCeiling}, {kRight, kBack, kEaves}, Material::kPlaster);
  AddBox(house.panels, {kLeft - 0.5, kFront - 0.5, kEaves}, {kRight + 0.5, kBack + 0.5, 8.7},
         Material::kSlate);
  const double bay = (kRight - kLeft - kPillar) / kBays;
  for (int i = 0; i <= kBays; ++i) {
    const double x = kLeft + i * bay;
    AddBox(house.panels, {x, kFront, -0.3}, {x + kPillar, kFront + kPillar, kCeiling},
           Material::kPlaster);
    if (i == kBays) break;
    AddArch(house.panels, x + kPillar, x + bay, kFront, kFront + kPillar, 2.1, kCeiling);
  }
  constexpr double kWidth = 1.5, kHeight = 1.8, kRightAngle = std::numbers::pi / 2;
  house.window = WindowBlock(kWidth, kHeight);
  for (const double sill : {3.9, 6.2}) {
    for (int i = 0; i < kBays; ++i) {
      const double x = kLeft + kPillar / 2 + (i + 0.5) * bay + kWidth / 2;
      house.windows.push_back({{x, kFront, sill}, 2 * kRightAngle});
    }
    for (int i = 0; i < 2; ++i) {
      house.windows.push_back({{kLeft, kFront + 0.9 + 2.6 * i, sill}, kRightAngle});
      house.windows.push_back({{kRight, kBack - 0.9 - 2.6 * i, sill}, -kRightAngle});
    }
  }
  return house;
}

std::vector<Stand> YardStands() {
  return {{{-11, -11.5, 1.65}, {0, 4, 3.4}}, {{-4.5, -12.3, 1.70}, {1, 4, 3.8}},
          {{4, -12.4, 1.65}, {1, 4, 3.9}},   {{11.8, -11.5, 1.65}, {2, 4, 3.4}},
          {{13.6, -5, 1.70}, {0, 4, 3.2}},   {{-13, -3, 1.65}, {2, 3.5, 3.3}},
          {{-13.2, 4.5, 1.70}, {3, 2, 3.2}}, {{-1.5, -12.6, 6.4}, {2, 4, 3.0}},
          {{13.8, 3.5, 1.65}, {-2, 1, 3.2}}};
}

Site MakeYard(int width, int height) {
  Site site;
  site.record = {"courtyard", "2024-01-17T11:30:00+01:00", "overcast", 47.3731, 8.5262};
  site.survey.check_points = {"white_5", "back_4", "left_5", "shed_4"};
  site.survey.control_points = {"white_0", "white_1", "white_4", "back_1",   "back_5",
                                "right_1", "right_4", "right_5", "left_0",   "left_1",
                                "left_4",  "shed_0",  "shed_7",  "shop_0_0", "shop_2_3"};
  site.survey.upright_boxes = {"white", "shed"};
  site.survey.level = site.survey.shadows = "paving";
  site.survey.daylight = Material::kWhitePlaster;
  site.origin = {2682310.0, 1248120.0, 409.2};
  site.azimuth = kYardAzimuth;
  const Eigen::AngleAxisd tilt(0.3 * kDegree, Vector3d(-0.8, 0.6, 0));
  const Eigen::Matrix3d site_from_plan =
      (tilt * Eigen::AngleAxisd(kYardAzimuth, Vector3d::UnitZ())).toRotationMatrix();
  site.zenith = tilt * Vector3d::UnitZ();
  site.true_north = tilt * Vector3d::UnitY();
  site.has_sun = false;
  site.sun = Vector3d::Zero();
  for (const auto& [name, point] : TargetsOnPaving()) {
    site.targets.emplace_back(name, site_from_plan * point);
  }
  const Plan plan(site_from_plan);
  std::vector<Face> faces = Houses(plan);
  site.blockers = MakeScene(faces);
  const auto yard = BoxCorners("paving", {{0, 0}, {30, 26}}, 0, 1);
  Face paving = plan.Polygon("paving", yard, {0, 1, 2, 3}, Material::kPaving);
  for (const auto& [name, point] : site.targets) paving.targets.push_back(paving.Local(point));
  faces.push_back(paving);
  site.natural = MakeScene(faces);
  site.scenery = MakeScene(Scenery(plan, -0.05, Material::kGravel));
  site.views = Photographs("yard_", YardStands(), DemoLens(width, height), site_from_plan);
  return site;
}

}  // namespace

SiteDescription DescribeCourtyard(int width, int height) {
  return {MakeYard(width, height), Turned(ArcadeHouse(), kYardAzimuth), Overcast()};
}

}  // namespace insitu::demo
