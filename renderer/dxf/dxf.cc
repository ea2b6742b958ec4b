// SPDX-License-Identifier: GPL-3.0-or-later
// A drawing's blocks, put where they are inserted.
#include "renderer/dxf/dxf.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "calibration/files/error.h"
#include "renderer/dxf/dxf_body.h"
#include "renderer/dxf/dxf_color.h"
#include "renderer/dxf/dxf_drawing.h"
#include "renderer/dxf/dxf_path.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kFarthest = 1e12;  // [m]

// What a block takes from its INSERT.
struct Holder {
  std::string layer = "0";      // what layer 0 stands for
  std::string block;            // innermost block that a user named
  std::optional<Vector3d> rgb;  // what BYBLOCK stands for
};

class Assembly {
 public:
  Assembly(const std::filesystem::path& path, DxfDrawing* drawing, const DxfOptions& options)
      : path_(path), drawing_(*drawing), options_(options), surface_index_(&model.mesh.surfaces) {}

  void Run();

  Model model;

 private:
  // A look as it comes out below a holder; nullopt: not shown.
  struct ResolvedLooks {
    std::vector<std::optional<int>> surfaces;
  };

  void Add(const DxfBlock& block, const Affine3d& world_from_block, const Holder& holder);
  void AddContent(const DxfBlock& block, const Affine3d& world_from_block, const Holder& holder);
  void AddTriangles(const DxfBlock& block, int first, bool mirrored, const ResolvedLooks& looks);
  void AddPath(const DxfPath& path, const Affine3d& world_from_block, const ResolvedLooks& looks);
  void AddBody(const DxfBody& body, const Affine3d& world_from_block, const ResolvedLooks& looks);
  void AddTriangle(const Vector3i& corners, int surface);
  void AddInsert(const DxfInsert& insert, const Affine3d& world_from_holder, const Holder& holder);
  void CountOnce(const DxfBlock& block);
  void CountUnusedBlocks();
  ResolvedLooks Resolve(const DxfBlock& block, const Holder& holder);
  std::optional<std::string> WhyHidden(const std::string& layer) const;
  void CountHidden(const DxfBlock& block, int look, const std::string& layer,
                   const std::string& reason);
  std::optional<Vector3d> ColorOf(const DxfLook& look, const std::string& layer,
                                  const Holder& holder) const;
  DxfLayer LayerNamed(const std::string& name) const;

  const std::filesystem::path& path_;
  DxfDrawing& drawing_;
  DxfOptions options_;
  SurfaceIndex surface_index_;
  std::set<const DxfBlock*> seen_;
  std::set<std::tuple<const DxfBlock*, int, std::string>> counted_hidden_;
};

DxfLayer Assembly::LayerNamed(const std::string& name) const {
  const auto found = drawing_.layers.find(NameKey(name));
  return found == drawing_.layers.end() ? DxfLayer{} : found->second;
}

std::optional<std::string> Assembly::WhyHidden(const std::string& layer) const {
  const DxfLayer state = LayerNamed(layer);
  const std::string quoted = "layer \"" + layer + "\" is ";
  if (state.frozen) return quoted + "frozen";
  if (state.off) return quoted + "switched off";
  if (state.no_plot || NameKey(layer) == "DEFPOINTS") return quoted + "not to be plotted";
  return std::nullopt;
}

std::optional<Vector3d> Assembly::ColorOf(const DxfLook& look, const std::string& layer,
                                          const Holder& holder) const {
  if (look.true_color) return LinearFromSrgb24(static_cast<uint32_t>(*look.true_color));
  if (look.color == kColorByBlock) return holder.rgb;
  if (look.color == kColorByLayer) return LayerNamed(layer).rgb;
  return ColorOfIndex(look.color);
}

void Assembly::CountHidden(const DxfBlock& block, int look, const std::string& layer,
                           const std::string& reason) {
  if (!counted_hidden_.emplace(&block, look, layer).second) return;
  for (const auto& [key, count] : block.kinds_of_look) {
    if (key.first == look) model.skipped[{key.second, reason}] += count;
  }
}

Assembly::ResolvedLooks Assembly::Resolve(const DxfBlock& block, const Holder& holder) {
  ResolvedLooks resolved;
  for (size_t i = 0; i < block.looks.size(); ++i) {
    const DxfLook& look = block.looks[i];
    const std::string& layer = look.layer == "0" ? holder.layer : look.layer;
    if (const auto reason = WhyHidden(layer)) {
      CountHidden(block, static_cast<int>(i), layer, *reason);
      resolved.surfaces.push_back(std::nullopt);
    } else {
      SurfaceNames names;
      names.layer = layer;
      names.block = holder.block;
      names.rgb = ColorOf(look, layer, holder);
      resolved.surfaces.push_back(surface_index_.IndexOf(names));
    }
  }
  return resolved;
}

void Assembly::AddTriangle(const Vector3i& corners, int surface) {
  ModelMesh& mesh = model.mesh;
  if (IsDegenerate(mesh.vertices[corners[0]], mesh.vertices[corners[1]],
                   mesh.vertices[corners[2]])) {
    ++model.degenerate_faces;  // flattened by the scale of its INSERT
    return;
  }
  mesh.triangles.push_back(corners);
  mesh.surface_of_triangle.push_back(surface);
}

void Assembly::AddTriangles(const DxfBlock& block, int first, bool mirrored,
                            const ResolvedLooks& looks) {
  for (size_t t = 0; t < block.triangles.size(); ++t) {
    const std::optional<int> surface = looks.surfaces[block.look_of_triangle[t]];
    if (!surface) continue;
    Vector3i corners = block.triangles[t] + Vector3i::Constant(first);
    if (mirrored) std::swap(corners[1], corners[2]);
    AddTriangle(corners, *surface);
  }
}

void Assembly::AddPath(const DxfPath& path, const Affine3d& world_from_block,
                       const ResolvedLooks& looks) {
  const std::optional<int> surface = looks.surfaces[path.look];
  if (!surface) return;
  const double scale = world_from_block.linear().colwise().norm().maxCoeff();
  const FacetedPath facets = Facet(path, options_.chord_tolerance / scale);
  std::vector<Vector3d>& all = model.mesh.vertices;
  const int first = static_cast<int>(all.size());
  if (static_cast<double>(all.size()) > options_.most_pieces * 2) {
    throw InputError(path_, "arcs come to too many facets");
  }
  for (const Vector3d& vertex : facets.vertices) all.push_back(world_from_block * vertex);
  const bool mirrored = world_from_block.linear().determinant() < 0;
  for (const std::vector<int>& face : facets.faces) {
    const std::vector<Vector3i> triangles = FaceTriangles(facets.vertices, face);
    if (triangles.empty()) ++model.degenerate_faces;
    for (const Vector3i& triangle : triangles) {
      Vector3i corners = triangle + Vector3i::Constant(first);
      if (mirrored) std::swap(corners[1], corners[2]);
      AddTriangle(corners, *surface);
    }
  }
}

void Assembly::AddBody(const DxfBody& body, const Affine3d& world_from_block,
                       const ResolvedLooks& looks) {
  const std::optional<int> surface = looks.surfaces[body.look];
  if (!surface) return;
  const auto known = drawing_.body_of_handle.find(DxfHandle(body.handle));
  const std::string sab = known == drawing_.body_of_handle.end() ? "" : known->second;
  std::vector<Vector3d>& all = model.mesh.vertices;
  const int first = static_cast<int>(all.size());
  const double most = options_.most_pieces * 2 - static_cast<double>(all.size());
  if (most < 0) throw InputError(path_, "bodies come to too many facets");
  const FacetedBody facets = Facet(body, sab, world_from_block, {options_.chord_tolerance, most});
  all.insert(all.end(), facets.vertices.begin(), facets.vertices.end());
  for (const Vector3i& triangle : facets.triangles) {
    AddTriangle(triangle + Vector3i::Constant(first), *surface);
  }
  for (ModelSphere sphere : facets.spheres) {
    sphere.surface = *surface;
    model.mesh.spheres.push_back(sphere);
  }
  for (const auto& [what, count] : facets.skipped) model.skipped[what] += count;
}

void Assembly::CountOnce(const DxfBlock& block) {
  if (!seen_.insert(&block).second) return;
  for (const auto& [what, count] : block.skipped) model.skipped[what] += count;
  model.degenerate_faces += block.degenerate_faces;
}

void Assembly::AddContent(const DxfBlock& block, const Affine3d& world_from_block,
                          const Holder& holder) {
  const ResolvedLooks looks = Resolve(block, holder);
  const bool mirrored = world_from_block.linear().determinant() < 0;
  std::vector<Vector3d>& all = model.mesh.vertices;
  const size_t first = all.size();
  if (&block == &drawing_.model_space) {
    all = std::move(drawing_.model_space.vertices);  // the bulk of a large drawing
  } else {
    all.insert(all.end(), block.vertices.begin(), block.vertices.end());
  }
  for (size_t i = first; i < all.size(); ++i) all[i] = world_from_block * all[i];
  AddTriangles(block, static_cast<int>(first), mirrored, looks);
  for (const DxfPath& path : block.paths) AddPath(path, world_from_block, looks);
  for (const DxfBody& body : block.bodies) AddBody(body, world_from_block, looks);
}

void Assembly::Add(const DxfBlock& block, const Affine3d& world_from_block, const Holder& holder) {
  CountOnce(block);
  AddContent(block, world_from_block, holder);
  for (const DxfInsert& insert : block.inserts) AddInsert(insert, world_from_block, holder);
}

void Assembly::AddInsert(const DxfInsert& insert, const Affine3d& world_from_holder,
                         const Holder& holder) {
  const DxfBlock& block = InsertedBlock(drawing_, insert);
  const std::string layer = insert.look.layer == "0" ? holder.layer : insert.look.layer;
  if (block.external) {
    const std::string why = block.why_unread.empty() ? "which is not read" : block.why_unread;
    ++model.skipped[{"INSERT", "of the external drawing \"" + block.external_file + "\", " + why}];
  }
  if (LayerNamed(layer).frozen) {
    seen_.insert(&block);
    ++model.skipped[{"INSERT", *WhyHidden(layer)}];
    return;
  }
  Holder inner{layer, holder.block, ColorOf(insert.look, layer, holder)};
  if (const std::string name = NameByUser(drawing_, insert.block); !name.empty()) {
    inner.block = name;
  }
  for (int row = 0; row < insert.rows; ++row) {
    for (int column = 0; column < insert.columns; ++column) {
      const Vector3d step = column * insert.column_step + row * insert.row_step;
      const Affine3d world_from_block = world_from_holder * Eigen::Translation3d(step) *
                                        insert.holder_from_block *
                                        Eigen::Translation3d(-block.base);
      if (!(world_from_block.matrix().array().abs() <= kFarthest).all()) {
        throw insert.place.Error("an INSERT that puts its block beyond 1e12 m");
      }
      Add(block, world_from_block, inner);
    }
  }
}

void Assembly::CountUnusedBlocks() {
  for (const auto& [key, block] : drawing_.blocks) {
    for (const auto& [kind, count] : block.entities) model.entities[kind] += count;
    const bool layout = key.starts_with("*MODEL_SPACE") || key.starts_with("*PAPER_SPACE") ||
                        key.starts_with("$MODEL_SPACE") || key.starts_with("$PAPER_SPACE");
    if (seen_.contains(&block) || block.entities.empty() || layout) continue;
    ++model.skipped[{"BLOCK", "no INSERT shows it"}];
  }
}

void Assembly::Run() {
  model.metres_per_unit = drawing_.metres_per_unit;
  model.warnings = drawing_.warnings;
  model.files = drawing_.files;
  model.entities = drawing_.model_space.entities;
  const Affine3d metres_from_units(Eigen::Scaling(drawing_.metres_per_unit.value_or(1)));
  Add(drawing_.model_space, metres_from_units, {});
  CountUnusedBlocks();
  DropUnused(&model.mesh);
}

// Source: the list of versions in the DXF reference.
std::string VersionName(const std::string& version) {
  static const std::map<std::string, std::string> kNames = {
      {"AC1006", "R10"},  {"AC1009", "R12"},  {"AC1012", "R13"},  {"AC1014", "R14"},
      {"AC1015", "2000"}, {"AC1018", "2004"}, {"AC1021", "2007"}, {"AC1024", "2010"},
      {"AC1027", "2013"}, {"AC1032", "2018"}};
  const auto found = kNames.find(version);
  if (found != kNames.end()) return " " + found->second;
  return version.empty() ? "" : " " + version;
}

}  // namespace

void DxfOptions::Check() const {
  INSITU_CHECK(chord_tolerance > 0);
  INSITU_CHECK(most_pieces > 0);
}

Model ReadDxf(const std::filesystem::path& path, const DxfOptions& options) {
  options.Check();
  const std::filesystem::path& beside = options.stands_for.empty() ? path : options.stands_for;
  DxfDrawing drawing = ReadDxfDrawing(path, options.most_pieces, beside);
  Assembly assembly(path, &drawing, options);
  assembly.Run();
  assembly.model.format =
      "DXF" + VersionName(drawing.version) + (drawing.binary ? ", binary" : ", ASCII");
  return std::move(assembly.model);
}

}  // namespace insitu
