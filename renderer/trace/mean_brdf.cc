// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/mean_brdf.h"

#include <algorithm>
#include <map>
#include <string>

#include "radiometry/light/illumination.h"
#include "renderer/trace/light_split.h"

namespace insitu {
namespace {

// A few points spread over a polygon: the centroids of its triangles' halves.
std::vector<SurfacePoint> PointsOn(const MontageScene& scene, const PolygonMesh& polygons,
                                   int polygon) {
  std::vector<SurfacePoint> points;
  const Eigen::Vector3d normal = scene.natural.scene.polygons[polygon].normal;
  for (size_t t = 0; t < polygons.mesh.triangles.size(); ++t) {
    if (polygons.polygon_of_triangle[t] != polygon) continue;
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = polygons.mesh.vertices[polygons.mesh.triangles[t][k]].cast<double>();
    }
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d weights = Eigen::Vector3d::Constant(0.2);
      weights[k] = 0.6;
      points.push_back({corners * weights, normal});
    }
  }
  return points;
}

struct MeanBrdf {
  Spectrum sum = Spectrum::Zero();
  int count = 0;

  void Add(const MeanBrdf& other) {
    sum += other.sum;
    count += other.count;
  }
  Spectrum Value() const { return sum / std::max(count, 1); }
};

MeanBrdf MeanOver(const MontageScene& scene, const std::vector<SurfacePoint>& points, int polygon) {
  MeanBrdf mean;
  const LightDirections all = {scene.natural.light.sun_direction, 0, 1};
  for (const SurfacePoint& point : points) {
    const auto seen = LookUpColor(scene.Photographed(), polygon, point);
    if (!seen) continue;
    const SplitLight light = SplitDaylight(scene, point, all, true);
    const Spectrum E = TotalIrradiance(scene.natural.light, light.natural);
    mean.Add({DiffuseBrdf(*seen, 1, E), 1});
  }
  return mean;
}

}  // namespace

std::vector<Spectrum> MeanBrdfOfPolygons(const MontageScene& scene) {
  const std::vector<Polygon>& polygons = scene.natural.scene.polygons;
  const PolygonMesh mesh = MeshOfPolygons(scene.natural.scene);
  std::map<std::string, MeanBrdf> of_material;
  MeanBrdf of_site;
  for (size_t i = 0; i < polygons.size(); ++i) {
    const int polygon = static_cast<int>(i);
    const MeanBrdf mean = MeanOver(scene, PointsOn(scene, mesh, polygon), polygon);
    of_material[polygons[i].material].Add(mean);
    of_site.Add(mean);
  }
  std::vector<Spectrum> result;
  for (const Polygon& polygon : polygons) {
    const MeanBrdf& mean = of_material[polygon.material];
    result.push_back(mean.count > 0 ? mean.Value() : of_site.Value());
  }
  return result;
}

}  // namespace insitu
