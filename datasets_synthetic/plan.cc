// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/plan.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct BoxSide {
  const char* suffix;
  std::vector<int> order;
};

// Walls w0 (front), w1 (right), w2 (back), w3 (left), top and bot.
const std::vector<BoxSide>& BoxSides() {
  static const std::vector<BoxSide> sides = {{"w0", {0, 1, 5, 4}},  {"w1", {1, 2, 6, 5}},
                                             {"w2", {2, 3, 7, 6}},  {"w3", {3, 0, 4, 7}},
                                             {"top", {4, 5, 6, 7}}, {"bot", {3, 2, 1, 0}}};
  return sides;
}

// Hills as a ring of upright faces whose crest is noise.
std::vector<Face> Ridge(const Plan& plan, double radius, double low, double high, uint64_t seed) {
  const auto foot = [radius](int i) {
    const double heading = (-90 + 1.5 * i) * kDegree;
    return Vector3d(radius * std::sin(heading), radius * std::cos(heading), -5);
  };
  const auto crest = [&](int i) -> Vector3d {
    const double rise =
        0.7 * ValueNoise(0.09 * i, 0.5, seed) + 0.3 * ValueNoise(0.4 * i, 0.5, seed);
    return foot(i) + Vector3d(0, 0, 5 + std::lerp(low, high, rise));
  };
  std::vector<Face> faces;
  for (int i = 0; i < 120; ++i) {
    const std::vector<NamedPoint> corners = {
        {"", foot(i)}, {"", foot(i + 1)}, {"", crest(i + 1)}, {"", crest(i)}};
    faces.push_back(plan.Polygon("hill", corners, {0, 1, 2, 3}, Material::kForest));
    faces.back().vertex_names.clear();
  }
  return faces;
}

}  // namespace

Face Plan::Polygon(const std::string& name, const std::vector<NamedPoint>& corners,
                   const std::vector<int>& order, Material material,
                   const WindowGrid& windows) const {
  Face face;
  face.name = name;
  face.material = material;
  face.windows = windows;
  for (const int index : order) {
    face.vertices.push_back(site_from_plan_ * corners[index].second);
    face.vertex_names.push_back(corners[index].first);
  }
  return FinishFace(face);
}

std::vector<NamedPoint> BoxCorners(const std::string& name, const Footprint& footprint,
                                   double bottom, double top) {
  std::vector<NamedPoint> corners;
  for (const double height : {bottom, top}) {
    for (const Vector2d& sign :
         {Vector2d(-1, -1), Vector2d(1, -1), Vector2d(1, 1), Vector2d(-1, 1)}) {
      const Vector2d at = footprint.center + Eigen::Rotation2Dd(footprint.turn) *
                                                 (0.5 * sign.cwiseProduct(footprint.size)).eval();
      corners.emplace_back(name + "_" + std::to_string(corners.size()),
                           Vector3d(at.x(), at.y(), height));
    }
  }
  return corners;
}

std::vector<Face> BoxFaces(const Plan& plan, const std::string& name,
                           const std::vector<NamedPoint>& corners, int count, Material material) {
  std::vector<Face> faces;
  for (int i = 0; i < count; ++i) {
    const BoxSide& side = BoxSides()[i];
    faces.push_back(plan.Polygon(name + "_" + side.suffix, corners, side.order, material));
  }
  return faces;
}

void Append(std::vector<Face>& faces, std::vector<Face> more) {
  faces.insert(faces.end(), more.begin(), more.end());
}

std::vector<Face> Scenery(const Plan& plan, double height, Material ground_material) {
  const double reach = 4000;
  const std::vector<NamedPoint> square = {{"", {-reach, -reach, height}},
                                          {"", {reach, -reach, height}},
                                          {"", {reach, reach, height}},
                                          {"", {-reach, reach, height}}};
  Face ground = plan.Polygon("ground", square, {0, 1, 2, 3}, ground_material);
  ground.vertex_names.clear();
  std::vector<Face> faces = {ground};
  Append(faces, Ridge(plan, 520, 7, 26, 5));
  Append(faces, Ridge(plan, 1500, 40, 190, 9));
  return faces;
}

View Photograph(const std::string& name, const Lens& lens, const Eigen::Matrix3d& site_from_plan,
                const Vector3d& center, const Vector3d& target, double roll) {
  const Vector3d forward = (target - center).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d upright;
  upright << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  const Eigen::Matrix3d cam_from_plan = Eigen::AngleAxisd(roll, Vector3d::UnitZ()) * upright;
  return {name, lens, site_from_plan * center, cam_from_plan * site_from_plan.transpose()};
}

std::vector<View> Photographs(const std::string& prefix, const std::vector<Stand>& stands,
                              const Lens& lens, const Eigen::Matrix3d& site_from_plan) {
  std::vector<View> views;
  for (const Stand& stand : stands) {
    const double roll = 0.3 * (static_cast<double>(views.size() % 3) - 1) * kDegree;
    views.push_back(Photograph(prefix + std::to_string(views.size() + 1), lens, site_from_plan,
                               stand.center, stand.target, roll));
  }
  return views;
}

}  // namespace insitu::demo
