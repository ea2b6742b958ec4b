// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/element_measures.h"

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <vector>

#include "renderer/mesh/near_vertices.h"
#include "renderer/mesh/open_edges.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

// Sums over the faces of one layer, about its first vertex: far coordinates lose nothing.
struct MeasureSums {
  std::optional<Vector3d> origin;
  double area = 0, volume = 0;
  double sphere_area = 0, sphere_volume = 0;
  EdgeCounts edges;
};

// `first` tells which vertices are one.
void AddTriangle(const ModelMesh& mesh, const Eigen::Vector3i& triangle,
                 const std::vector<int>& first, MeasureSums* sums) {
  if (!sums->origin) sums->origin = mesh.vertices[triangle[0]];
  const Vector3d a = mesh.vertices[triangle[0]] - *sums->origin;
  const Vector3d b = mesh.vertices[triangle[1]] - *sums->origin;
  const Vector3d c = mesh.vertices[triangle[2]] - *sums->origin;
  sums->area += (b - a).cross(c - a).norm() / 2;
  sums->volume += a.dot(b.cross(c)) / 6;
  for (int i = 0; i < 3; ++i) {
    const int from = first[triangle[i]], to = first[triangle[(i + 1) % 3]];
    AddEdge(from, to, 1, &sums->edges);
  }
}

void AddSphere(const ModelSphere& sphere, MeasureSums* sums) {
  const double area = 4 * std::numbers::pi * sphere.radius * sphere.radius;
  sums->sphere_area += area;
  sums->sphere_volume += area * sphere.radius / 3;
}

}  // namespace

std::map<std::string, ElementMeasures> MeasuresByLayer(const ModelMesh& mesh) {
  std::map<std::string, MeasureSums> sums;
  std::vector<MeasureSums*> sums_of_surface;
  for (const SurfaceNames& names : mesh.surfaces) sums_of_surface.push_back(&sums[names.layer]);
  const std::vector<int> first = FirstOfNear(mesh.vertices, kJoinTolerance);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    AddTriangle(mesh, mesh.triangles[t], first, sums_of_surface[mesh.surface_of_triangle[t]]);
  }
  for (const ModelSphere& sphere : mesh.spheres) AddSphere(sphere, sums_of_surface[sphere.surface]);
  std::map<std::string, ElementMeasures> elements;
  for (const auto& [layer, sum] : sums) {
    if (!sum.origin && sum.sphere_area == 0) continue;
    ElementMeasures& element = elements[layer];
    element.area = sum.area + sum.sphere_area;
    element.open_edges = static_cast<int>(CutAtCorners(sum.edges, mesh.vertices).size());
    if (element.open_edges == 0) element.volume = sum.volume + sum.sphere_volume;
  }
  return elements;
}

ElementMeasures Sum(const std::map<std::string, ElementMeasures>& elements) {
  ElementMeasures all;
  all.volume = 0;
  for (const auto& [name, element] : elements) {
    all.area += element.area;
    all.open_edges += element.open_edges;
    if (!element.volume) all.volume.reset();
    if (all.volume) *all.volume += *element.volume;
  }
  return all;
}

}  // namespace insitu
