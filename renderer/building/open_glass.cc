// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/open_glass.h"

#include "renderer/mesh/element_measures.h"

namespace insitu {

std::vector<std::string> OpenGlassBodies(const ModelMesh& mesh,
                                         const ArtificialEnvironment& environment) {
  ModelMesh bodies;
  for (const SurfaceMaterial& material : environment.materials) {
    bodies.surfaces.emplace_back().layer = material.name;
  }
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int material = environment.material_of_triangle[t];
    const auto& glass = environment.materials[material].glass;
    if (!glass || !glass->is_solid) continue;
    bodies.triangles.push_back(mesh.triangles[t]);
    bodies.surface_of_triangle.push_back(material);
  }
  if (bodies.triangles.empty()) return {};
  bodies.vertices = mesh.vertices;
  std::vector<std::string> open;
  for (const auto& [name, measures] : MeasuresByLayer(bodies)) {
    if (!measures.volume) open.push_back(name);
  }
  return open;
}

}  // namespace insitu
