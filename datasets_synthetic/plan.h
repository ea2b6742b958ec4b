// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing a place on plan: boxes, ground, hills and photographers.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "datasets_synthetic/lens.h"
#include "datasets_synthetic/scene.h"

namespace insitu::demo {

using NamedPoint = std::pair<std::string, Eigen::Vector3d>;

// The plan's axes: x to the photographers' right, y away from them, z to the true zenith.
class Plan {
 public:
  explicit Plan(const Eigen::Matrix3d& site_from_plan) : site_from_plan_(site_from_plan) {}

  // A face through corners by number.
  Face Polygon(const std::string& name, const std::vector<NamedPoint>& corners,
               const std::vector<int>& order, Material material,
               const WindowGrid& windows = {}) const;

 private:
  Eigen::Matrix3d site_from_plan_;
};

struct Footprint {
  Eigen::Vector2d center, size;  // [m]
  double turn = 0;               // [rad], counter-clockwise
};

// Corners 0..3 counter-clockwise at `bottom` from the lower left, 4..7 above them at `top`.
std::vector<NamedPoint> BoxCorners(const std::string& name, const Footprint& footprint,
                                   double bottom, double top);

// The first `count` of a box's walls w0 (front), w1 (right), w2 (back), w3 (left), top and bot.
std::vector<Face> BoxFaces(const Plan& plan, const std::string& name,
                           const std::vector<NamedPoint>& corners, int count, Material material);

void Append(std::vector<Face>& faces, std::vector<Face> more);

// Ground 4 km to all sides at `height` [m] and two ranges of wooded hills; not surveyed.
std::vector<Face> Scenery(const Plan& plan, double height, Material ground);

// A photograph from `center` towards `target`, plan coordinates; `roll` [rad] about the sight.
View Photograph(const std::string& name, const Lens& lens, const Eigen::Matrix3d& site_from_plan,
                const Eigen::Vector3d& center, const Eigen::Vector3d& target, double roll);

struct Stand {
  Eigen::Vector3d center, target;
};

// `prefix`1, `prefix`2, ... from each stand; the camera is held a little askew.
std::vector<View> Photographs(const std::string& prefix, const std::vector<Stand>& stands,
                              const Lens& lens, const Eigen::Matrix3d& site_from_plan);

}  // namespace insitu::demo
