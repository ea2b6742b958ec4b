// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/convert.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <set>

#include "calibration/error.h"
#include "renderer/building_materials.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Kinds that may carry surfaces in a form that we do not read.
const std::set<std::string> kUnreadSurfaces = {
    "3DSOLID",       "BODY",         "REGION",          "SURFACE",      "EXTRUDEDSURFACE",
    "LOFTEDSURFACE", "PLANESURFACE", "REVOLVEDSURFACE", "SWEPTSURFACE", "NURBSURFACE"};

bool IsDrawing(const fs::directory_entry& entry) {
  std::string ending = entry.path().extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return entry.is_regular_file() && ending == ".dxf";
}

std::vector<fs::path> ListDrawings(const fs::path& folder) {
  std::vector<fs::path> drawings;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) {
    if (IsDrawing(entry)) drawings.push_back(entry.path());
  }
  if (drawings.empty()) throw InputError(folder, "no drawing, expected at least one *.dxf");
  std::ranges::sort(drawings);
  return drawings;
}

// "12 LINE, 3 TEXT"
std::string Listed(const std::map<std::string, int>& counts) {
  std::string list;
  for (const auto& [kind, count] : counts) {
    list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return list;
}

class Converter {
 public:
  explicit Converter(const fs::path& materials) : file_(materials) {
    materials_ = ReadBuildingMaterials(materials);
  }
  void Add(const fs::path& drawing);
  Conversion Finish();

 private:
  void Warn(const fs::path& file, const std::string& message) {
    conversion_.warnings.push_back(InputError(file, message).what());
  }
  void WarnOf(const fs::path& drawing, const DxfModel& model);
  void AddMesh(const LayeredMesh& mesh);
  int MaterialOf(const std::string& layer);

  fs::path file_;
  std::map<std::string, SurfaceMaterial> materials_;
  std::map<std::string, int> index_of_layer_;
  Conversion conversion_;
};

void Converter::WarnOf(const fs::path& drawing, const DxfModel& model) {
  if (!model.metres_per_unit) Warn(drawing, "names no unit ($INSUNITS): taken as metres");
  std::map<std::string, int> unread, without_surface;
  for (const auto& [kind, count] : model.skipped) {
    (kUnreadSurfaces.contains(kind) ? unread : without_surface)[kind] = count;
  }
  if (!unread.empty()) {
    Warn(drawing, "left out, though they may carry surfaces: " + Listed(unread) +
                      " (save them as MESH, polyface or 3DFACE)");
  }
  if (!without_surface.empty()) Warn(drawing, "left out: " + Listed(without_surface));
  if (!model.hidden.empty()) {
    Warn(drawing, "left out on frozen or switched-off layers: " + Listed(model.hidden));
  }
  if (model.degenerate_faces > 0) {
    Warn(drawing, "left out: " + std::to_string(model.degenerate_faces) +
                      " faces of no area, or whose outline crosses itself");
  }
  if (model.smoothed_meshes > 0) {
    Warn(drawing, "read without its smoothing: " + std::to_string(model.smoothed_meshes) + " MESH");
  }
}

int Converter::MaterialOf(const std::string& layer) {
  auto& materials = conversion_.environment.materials;
  const auto [known, is_new] =
      index_of_layer_.try_emplace(layer, static_cast<int>(materials.size()));
  if (!is_new) return known->second;
  const auto listed = materials_.find(layer);
  if (listed == materials_.end()) {
    Warn(file_, "layer \"" + layer + "\" of the drawing is not listed: shown in mid grey");
    SurfaceMaterial grey;
    grey.name = layer;
    materials.push_back(grey);
  } else {
    materials.push_back(listed->second);
  }
  return known->second;
}

void Converter::AddMesh(const LayeredMesh& mesh) {
  ArtificialEnvironment& environment = conversion_.environment;
  const int first = static_cast<int>(environment.vertices.size());
  environment.vertices.insert(environment.vertices.end(), mesh.vertices.begin(),
                              mesh.vertices.end());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    environment.triangles.push_back(mesh.triangles[t] + Eigen::Vector3i::Constant(first));
    environment.material_of_triangle.push_back(MaterialOf(mesh.layers[mesh.layer_of_triangle[t]]));
  }
}

void Converter::Add(const fs::path& drawing) {
  const DxfModel model = ReadDxf(drawing);
  if (model.mesh.triangles.empty()) {
    throw InputError(drawing,
                     "has no surface to show, expected 3DFACE, MESH, polyface or polygon "
                     "mesh; it has " +
                         (model.skipped.empty() ? "nothing" : Listed(model.skipped)));
  }
  WarnOf(drawing, model);
  AddMesh(model.mesh);
}

Conversion Converter::Finish() {
  for (const auto& [layer, material] : materials_) {
    if (!index_of_layer_.contains(layer)) {
      Warn(file_, "layer \"" + layer + "\" is listed but carries nothing in the drawing");
    }
  }
  return std::move(conversion_);
}

Eigen::AlignedBox3d BoxOf(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
  return box;
}

std::string Written(const Eigen::Vector3d& point) {
  char text[100];
  std::snprintf(text, sizeof(text), "(%.3f, %.3f, %.3f)", point.x(), point.y(), point.z());
  return text;
}

}  // namespace

Conversion ConvertBuilding(const SitePaths& site) {
  const std::vector<fs::path> drawings = ListDrawings(site.building());
  Converter converter(site.building() / "materials.json");
  for (const fs::path& drawing : drawings) converter.Add(drawing);
  Conversion conversion = converter.Finish();
  const fs::path lights = site.building() / "lights.json";
  if (fs::exists(lights)) conversion.environment.lights = ReadPointLights(lights);
  return conversion;
}

std::string Conversion::BriefReport() const {
  const Eigen::AlignedBox3d box = BoxOf(environment.vertices);
  std::vector<int> triangles(environment.materials.size());
  for (const int material : environment.material_of_triangle) ++triangles[material];
  std::string report = std::to_string(environment.triangles.size()) + " triangles, " +
                       std::to_string(environment.lights.size()) + " lights\n";
  report += "  from " + Written(box.min()) + " to " + Written(box.max()) + " m\n";
  for (size_t m = 0; m < triangles.size(); ++m) {
    report += "  " + environment.materials[m].name + ": " + std::to_string(triangles[m]) + "\n";
  }
  for (const std::string& warning : warnings) report += "warning: " + warning + "\n";
  return report;
}

}  // namespace insitu
