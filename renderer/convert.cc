// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/convert.h"

#include <algorithm>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/program.h"
#include "renderer/building/building_lights.h"
#include "renderer/building/building_materials.h"
#include "renderer/building/data_map.h"
#include "renderer/building/material_maps.h"
#include "renderer/building/model_notes.h"
#include "renderer/building/open_glass.h"
#include "renderer/building/site_check.h"
#include "renderer/formats/model_list.h"
#include "renderer/formats/model_textures.h"
#include "renderer/mesh/overlaid_faces.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

// "12 LINE, 3 TEXT"
std::string Listed(const std::map<std::string, int>& counts) {
  std::string list;
  for (const auto& [kind, count] : counts) {
    list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return list;
}

std::string Listed(const std::set<std::string>& names) {
  constexpr size_t kMost = 30;
  std::string list;
  size_t listed = 0;
  for (auto name = names.begin(); name != names.end() && listed < kMost; ++name, ++listed) {
    list += (list.empty() ? "\"" : ", \"") + *name + "\"";
  }
  return listed == names.size() ? list : list + Formatted(" and %zu more", names.size() - listed);
}

// What a surface that materials.json does not list is called in messages and in the description.
std::string LabelOf(const SurfaceNames& names) {
  return names.material.empty() ? names.layer : names.material;
}

// A drawing's colours tell layers apart on a screen: white and black become mid grey, no channel
// exceeds what a surface reflects.
Vector3d ShownColor(const Vector3d& rgb) {
  constexpr double kBrightest = 0.8, kDarkest = 0.02;
  const bool is_grey = rgb.maxCoeff() - rgb.minCoeff() < 1e-9;
  if (is_grey && (rgb[0] > kBrightest || rgb[0] < kDarkest)) return Vector3d::Constant(0.5);
  return rgb.cwiseMin(kBrightest).cwiseMax(kDarkest);
}

class Converter {
 public:
  Converter(const SitePaths& site, const ConvertOptions& options)
      : site_(site),
        options_(options),
        place_(fs::exists(site.building()) ? site.building() : options.models.front()),
        file_(fs::exists(site.building()) ? site.building() / "materials.json" : place_),
        library_(LibraryFolders(site)),
        materials_(BuildingMaterials::Read(site.building() / "materials.json", library_)) {}

  void Add(const fs::path& path);
  Conversion Finish();
  const std::vector<fs::path>& files() const { return files_; }  // that the models named

 private:
  void Warn(const fs::path& file, const std::string& message) {
    conversion_.warnings.push_back(InputError(file, message).what());
  }
  void WarnOfPairs(const Placement& placement);
  void ResolveMaterials();
  int MaterialOf(const SurfaceNames& names);
  int Unlisted(const SurfaceNames& names);
  std::string FromBuilding(const std::string& file) const;
  void TakeMeanColor(const SurfaceNames& names, SurfaceMaterial* material);
  void WarnOfMaterials();
  void WarnOfTexturedSpheres();
  void WarnOfSolids();
  void DropHidden(const std::vector<std::optional<int>>& material_of_surface);

  SitePaths site_;
  ConvertOptions options_;
  fs::path place_, file_;  // for messages: building/ and materials.json there, or a model alone
  MaterialLibrary library_;
  BuildingMaterials materials_;
  ModelMesh mesh_;
  std::vector<ModelLamp> lamps_;  // in the world
  std::vector<fs::path> files_;
  std::map<const BuildingMaterial*, int> index_of_material_;
  std::map<std::string, int> index_of_unlisted_;
  std::set<std::string> grey_, own_color_, hidden_;
  Conversion conversion_;
};

void Converter::WarnOfPairs(const Placement& placement) {
  if (!placement.adjusted) return;
  const fs::path file = site_.building() / "placement.json";
  constexpr double kWorst = 3;  // sigmas
  for (size_t i = 0; i < placement.pairs.size(); ++i) {
    const double off = placement.adjusted->residuals[i].norm();
    const double sigma = placement.pairs[i].points.sigma.x();
    if (off <= kWorst * sigma) continue;
    Warn(file, Formatted("%s is %.3f m off, of a sigma of %.3f m", placement.pairs[i].name.c_str(),
                         off, sigma));
  }
  const double scale = placement.adjusted->free_scale;
  if (std::abs(scale - 1) > 0.01 && placement.world_from_model.scale == 1) {
    Warn(file, "the pairs would fit a model " + std::to_string(scale) +
                   " times as large: is its unit right?");
  }
}

void Converter::Add(const fs::path& path) {
  Model model = ReadModel(path, options_.import);
  const double unit = model.metres_per_unit.value_or(1);
  ModelReport report;
  report.file = path;
  report.format = model.format;
  report.metres_per_unit = model.metres_per_unit;
  report.triangles = static_cast<int>(model.mesh.triangles.size());
  report.spheres = static_cast<int>(model.mesh.spheres.size());
  const Eigen::AlignedBox3d box = BoxOf(model.mesh);
  if (!box.isEmpty()) report.box_in_units = {box.min() / unit, box.max() / unit};
  report.placement = ReadPlacement(site_, path.filename().string(), unit, model.map_from_model);
  report.entities = model.entities;
  report.skipped = model.skipped;
  report.degenerate_faces = model.degenerate_faces;
  LocateTextures(site_, path, &model);
  files_.insert(files_.end(), model.files.begin(), model.files.end());
  for (std::string& note : NotesOnModel(path, model, report.placement)) {
    conversion_.warnings.push_back(std::move(note));
  }
  WarnOfPairs(report.placement);
  Place(site_, report.placement, unit, &model.mesh);
  PlaceLamps(site_, report.placement, unit, &model.lamps);
  lamps_.insert(lamps_.end(), model.lamps.begin(), model.lamps.end());
  if (conversion_.models.empty()) {
    mesh_ = std::move(model.mesh);
  } else {
    Append(model.mesh, &mesh_);
  }
  conversion_.models.push_back(std::move(report));
}

std::string Converter::FromBuilding(const std::string& file) const {
  if (file.empty()) return "";
  std::error_code none;
  return fs::proximate(file, site_.building(), none).string();
}

// An image that cannot be read costs itself alone.
void Converter::TakeMeanColor(const SurfaceNames& names, SurfaceMaterial* material) {
  try {
    const Vector3d mean = MeanColor(ReadPhotograph(names.texture).linear);
    material->diffuse_rgb = material->diffuse_rgb.cwiseProduct(mean).cwiseMin(1);
  } catch (const InputError& error) {
    conversion_.warnings.push_back(std::string(error.what()) + ": the texture is left out of \"" +
                                   material->name + "\"");
    material->texture.clear();
  }
}

int Converter::Unlisted(const SurfaceNames& names) {
  auto& materials = conversion_.environment.materials;
  const std::string label = LabelOf(names);
  conversion_.unlisted.try_emplace(label, names.rgb);
  const bool has_color =
      !names.material.empty() && (names.rgb || !names.texture.empty() || !names.maps.empty());
  std::string key = label + '\0' + std::to_string(names.opacity) + FromBuilding(names.texture);
  for (const SurfaceMap& map : names.maps) key += '\0' + map.file;
  if (names.rgb) key.append(reinterpret_cast<const char*>(names.rgb->data()), 3 * sizeof(double));
  key.append(reinterpret_cast<const char*>(names.translucent_rgb.data()), 3 * sizeof(double));
  const auto [known, is_new] =
      index_of_unlisted_.try_emplace(key, static_cast<int>(materials.size()));
  if (!is_new) return known->second;
  SurfaceMaterial material;
  material.name = label;
  if (!has_color && names.rgb) material.diffuse_rgb = ShownColor(*names.rgb);
  if (has_color) {
    material.texture = FromBuilding(names.texture);
    material.diffuse_rgb = names.rgb.value_or(Vector3d(Vector3d::Ones()));
    if (!material.texture.empty()) TakeMeanColor(names, &material);
    material.diffuse_weight = names.diffuse_weight;
    material.translucent_rgb = names.translucent_rgb;
    if (names.opacity < 1) {
      material.glass = Glass{.weight = 1 - names.opacity,
                             .is_solid = names.is_solid,
                             .index = names.index,
                             .absorption_rgb = names.absorption_rgb};
    }
    AddModelMaps(names, site_.building(), &material, &conversion_.warnings);
  }
  (has_color || names.rgb ? own_color_ : grey_).insert(label);
  materials.push_back(material);
  return known->second;
}

int Converter::MaterialOf(const SurfaceNames& names) {
  const BuildingMaterial* listed = materials_.Find(names);
  if (!listed) return Unlisted(names);
  auto& materials = conversion_.environment.materials;
  const auto [known, is_new] =
      index_of_material_.try_emplace(listed, static_cast<int>(materials.size()));
  if (!is_new) return known->second;
  materials.push_back(listed->surface);
  conversion_.warnings.insert(conversion_.warnings.end(), listed->warnings.begin(),
                              listed->warnings.end());
  return known->second;
}

// Faces of materials that are said to be hidden go; the others get their material's index.
void Converter::ResolveMaterials() {
  std::vector<std::optional<int>> material_of_surface(mesh_.surfaces.size());
  for (size_t s = 0; s < mesh_.surfaces.size(); ++s) {
    const SurfaceNames& names = mesh_.surfaces[s];
    const BuildingMaterial* listed = materials_.Find(names);
    if (listed && listed->hidden) {
      hidden_.insert(listed->surface.name);
    } else {
      material_of_surface[s] = MaterialOf(names);
    }
  }
  DropHidden(material_of_surface);
}

void Converter::DropHidden(const std::vector<std::optional<int>>& material_of_surface) {
  ModelMesh shown;
  shown.surfaces = mesh_.surfaces;
  ArtificialEnvironment& environment = conversion_.environment;
  const bool all = std::ranges::all_of(material_of_surface, [](const auto& m) { return !!m; });
  if (!all) {
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!material_of_surface[mesh_.surface_of_triangle[t]]) continue;
      shown.triangles.push_back(mesh_.triangles[t]);
      shown.surface_of_triangle.push_back(mesh_.surface_of_triangle[t]);
      for (size_t c = 3 * t; c < 3 * t + 3; ++c) {
        if (!mesh_.corner_normals.empty()) shown.corner_normals.push_back(mesh_.corner_normals[c]);
        if (!mesh_.corner_uvs.empty()) shown.corner_uvs.push_back(mesh_.corner_uvs[c]);
      }
    }
    shown.vertices = std::move(mesh_.vertices);
    shown.spheres = std::move(mesh_.spheres);
    mesh_ = std::move(shown);
  }
  const auto count = [&](int surface) {
    const int material = *material_of_surface[surface];
    ++conversion_.triangles_of_layer[mesh_.surfaces[surface].layer];
    ++conversion_.triangles_of_material[environment.materials[material].name];
    return material;
  };
  for (const int surface : mesh_.surface_of_triangle) {
    environment.material_of_triangle.push_back(count(surface));
  }
  std::erase_if(mesh_.spheres,
                [&](const ModelSphere& s) { return !material_of_surface[s.surface]; });
  for (const ModelSphere& sphere : mesh_.spheres) {
    environment.spheres.push_back({sphere.center, sphere.radius, count(sphere.surface)});
  }
}

void Converter::WarnOfMaterials() {
  if (!grey_.empty()) {
    Warn(file_, "not listed, shown in mid grey: " + Listed(grey_));
  }
  if (!own_color_.empty()) {
    Warn(file_, "not listed, shown in the model's own colour: " + Listed(own_color_));
  }
  if (!hidden_.empty()) Warn(file_, "hidden: " + Listed(hidden_));
  const std::vector<std::string> proposed = materials_.Proposed();
  if (!proposed.empty()) {
    Warn(file_, "proposed and not taken, which \"use\" in the place of \"proposed\" does: " +
                    Listed(std::set<std::string>(proposed.begin(), proposed.end())));
  }
  for (const std::string& name : materials_.Unused()) {
    Warn(file_,
         name + " is listed but decides no face: materials go before blocks, those before layers");
  }
}

// An exact sphere has no place for an image.
void Converter::WarnOfTexturedSpheres() {
  std::map<std::string, int> spheres;
  for (const EnvironmentSphere& sphere : conversion_.environment.spheres) {
    const SurfaceMaterial& material = conversion_.environment.materials[sphere.material];
    if (!material.texture.empty()) ++spheres[material.name];
  }
  for (const auto& [name, count] : spheres) {
    Warn(file_, std::to_string(count) + " spheres of \"" + name +
                    "\" show the mean colour of its texture, not the image");
  }
}

void Converter::WarnOfSolids() {
  const SolidsReport& s = conversion_.solids;
  const auto warn = [this](int count, const std::string& what) {
    if (count > 0) Warn(place_, std::to_string(count) + " " + what);
  };
  warn(s.duplicate_faces, "faces dropped: they lie on others of the same name");
  warn(s.degenerate_faces, "faces dropped: they have no area");
  warn(s.coincident_faces, "faces lie on others of another name: which is seen is open");
  warn(s.flipped_faces, "faces of closed bodies turned to look outwards");
  warn(s.unmended_faces, "faces of open bodies look another way than their neighbours");
  warn(s.one_sided_bodies, "bodies cannot be given an outside");
}

Conversion Converter::Finish() {
  conversion_.solids = MendSolids(&mesh_);
  ResolveMaterials();
  WarnOfMaterials();
  WarnOfTexturedSpheres();
  for (const std::string& name : OpenGlassBodies(mesh_, conversion_.environment)) {
    Warn(file_, "\"" + name +
                    "\" is solid glass, and its faces leave a body open: light that meets no face "
                    "on its way out is lost; close it, or call it thin");
  }
  WarnOfSolids();
  DropUnused(&mesh_);
  conversion_.elements = MeasuresByLayer(mesh_);
  conversion_.box = BoxOf(mesh_);
  const int raised = RaiseOverlaidFaces(&mesh_);
  if (raised > 0) {
    Warn(place_, std::to_string(raised) +
                     " faces are drawn on larger ones of another name: put 2 mm before "
                     "them");
  }
  conversion_.layers = LayersOf(mesh_);
  ArtificialEnvironment& environment = conversion_.environment;
  environment.vertices = std::move(mesh_.vertices);
  environment.triangles = std::move(mesh_.triangles);
  environment.corner_normals = std::move(mesh_.corner_normals);
  environment.corner_uvs = std::move(mesh_.corner_uvs);
  std::optional<double> unit;  // of the first model that names one, as it was taken
  for (const ModelReport& model : conversion_.models) {
    const auto& placed = model.placement.metres_per_unit;
    if (!unit) unit = placed ? placed : model.metres_per_unit;
  }
  for (const std::string& suspicion : SuspicionsOf(conversion_.box, SiteBox(site_), unit)) {
    Warn(place_, suspicion);
  }
  const fs::path lights = site_.building() / "lights.json";
  if (fs::exists(lights)) environment.lights = ReadLights(lights, library_);
  for (PointLight& light : LightsOfModel(lamps_, lights)) {
    environment.lights.push_back(std::move(light));
  }
  return std::move(conversion_);
}

ModelList ModelsOf(const SitePaths& site, const ConvertOptions& options) {
  return options.models.empty() ? ListModels(site) : ModelList{options.models, {}, {}};
}

fs::path FileOf(const SitePaths& site, const Conversion& conversion) {
  return conversion.models.size() == 1 ? conversion.models.front().file : site.building();
}

// A size that no building has is a fault of reading or of units.
void RequireSize(const SitePaths& site, const Conversion& conversion) {
  constexpr double kSmallest = 1e-3, kLargest = 1e5;  // [m]
  const double size = conversion.box.diagonal().norm();
  if (size >= kSmallest && size <= kLargest) return;
  throw InputError(FileOf(site, conversion),
                   Formatted("is %.3g m across, expected 1 mm to 100 km: see \"unit\" and the "
                             "warnings of the report",
                             size));
}

}  // namespace

void ConvertOptions::Check() const { import.Check(); }

Conversion ConvertBuilding(const SitePaths& site, const ConvertOptions& options) {
  options.Check();
  ModelList models = ModelsOf(site, options);
  Converter converter(site, options);
  Progress progress("the building", static_cast<int>(models.files.size()) + 1);
  for (const fs::path& model : models.files) {
    converter.Add(model);
    progress.Step();
  }
  Conversion conversion = converter.Finish();
  conversion.chord_tolerance = options.import.dxf.chord_tolerance;
  std::string unread = UnreadFiles(site, models.others, converter.files());
  if (!unread.empty()) models.warnings.push_back(std::move(unread));
  conversion.warnings.insert(conversion.warnings.begin(), models.warnings.begin(),
                             models.warnings.end());
  return conversion;
}

void RequireSurface(const SitePaths& site, const Conversion& conversion) {
  const ArtificialEnvironment& building = conversion.environment;
  if (!building.triangles.empty() || !building.spheres.empty()) {
    return RequireSize(site, conversion);
  }
  std::map<std::string, int> entities, reasons;
  for (const ModelReport& model : conversion.models) {
    for (const auto& [kind, count] : model.entities) entities[kind] += count;
    for (const auto& [what, count] : model.skipped) {
      reasons[what.first + " left out (" + what.second + ")"] += count;
    }
    if (model.degenerate_faces > 0) {
      reasons["faces of no area, or whose outline crosses itself"] += model.degenerate_faces;
    }
  }
  const fs::path file = FileOf(site, conversion);
  throw InputError(file, "has no surface to show, expected faces, meshes or solids; it has " +
                             (entities.empty() ? "nothing" : Listed(entities)) +
                             (reasons.empty() ? "" : "; " + Listed(reasons)));
}

}  // namespace insitu
