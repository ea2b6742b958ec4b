// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/montage_points.h"

#include <Eigen/Geometry>
#include <cmath>

#include "calibration/files/json_file.h"

namespace insitu {
namespace {

// Lawns and streets reach far beyond what is built; walls tell where that stands.
std::vector<MontagePoint> BoxCorners(const SceneGeometry& scene) {
  constexpr double kLevel = 0.9;
  Eigen::AlignedBox3d box;
  for (const Polygon& polygon : scene.polygons) {
    if (std::abs(polygon.normal.dot(scene.zenith.unit)) > kLevel) continue;
    for (const Eigen::Vector3d& vertex : polygon.vertices) box.extend(vertex);
  }
  if (box.isEmpty()) return {};
  std::vector<MontagePoint> points;
  for (int i = 0; i < 8; ++i) {
    const std::string name = std::string("box ") + (i & 4 ? "top " : "bottom ") +
                             (i & 2 ? "max y " : "min y ") + (i & 1 ? "max x" : "min x");
    points.push_back({name, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))});
  }
  return points;
}

}  // namespace

std::vector<MontagePoint> MontagePoints(const SitePaths& site, const SceneGeometry& scene) {
  const auto path = site.root / "site.json";
  if (!std::filesystem::exists(path)) return BoxCorners(scene);
  const std::optional<JsonNode> given = JsonNode::Load(path).Find("report_points");
  if (!given) return BoxCorners(scene);
  std::vector<MontagePoint> points;
  for (const JsonNode& point : given->Items()) {
    points.push_back({point.At("name").Text(), point.At("position").Vector3()});
  }
  return points;
}

}  // namespace insitu
