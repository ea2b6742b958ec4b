// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/obj_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "calibration/color/color_space.h"
#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "renderer/foreign/file_reference.h"
#include "renderer/foreign/mesh_builder.h"
#include "renderer/formats/obj_material.h"
#include "renderer/formats/obj_words.h"
#include "renderer/formats/unit_comment.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

class ObjReader {
 public:
  explicit ObjReader(const fs::path& path) : path_(path), builder_(path, &model_) {
    model_.format = "OBJ";
  }

  Model Read() {
    ForEachObjLine(
        path_, [this](std::string_view keyword, ObjWords& words, int) { ReadLine(keyword, words); },
        [this](const std::string& line) { ReadComment(line); });
    for (Vector3d& vertex : model_.mesh.vertices) vertex *= model_.metres_per_unit.value_or(1);
    if (!colors_.empty()) builder_.SayColorsByVertex();
    if (uvs_.empty()) model_.mesh.corner_uvs.clear();
    if (normals_.empty()) model_.mesh.corner_normals.clear();
    DropUnused(&model_.mesh);
    return std::move(model_);
  }

 private:
  void ReadLine(std::string_view keyword, ObjWords& words) {
    ModelMesh& mesh = model_.mesh;
    if (keyword == "v") {
      mesh.vertices.push_back(words.Point());
      AddColor(words);
    } else if (keyword == "vt") {
      const std::optional<double> u = words.FindNumber(), v = words.FindNumber();
      if (!u) ++model_.skipped[{"vt", "no number: taken as 0"}];
      uvs_.emplace_back(static_cast<float>(u.value_or(0)), static_cast<float>(v.value_or(0)));
    } else if (keyword == "vn") {
      AddNormal(words);
    } else if (keyword == "f") {
      AddFace(words);
    } else if (keyword == "o" || keyword == "g" || keyword == "usemtl") {
      (keyword == "o" ? object_ : keyword == "g" ? group_ : material_) = words.Name();
      if (keyword == "o") group_.clear();
      surface_.reset();
    } else if (keyword == "mtllib") {
      ReadLibraries(words.Name());
    } else if (keyword == "s" || keyword == "vp") {
      return;  // smoothing is told by vn; parameter space is of curves
    } else {
      Skip(std::string(keyword));
    }
  }

  // "v x y z r g b", as scanners and MeshLab write it; of "x y z w", none.
  void AddColor(ObjWords& words) {
    const std::optional<double> r = words.FindNumber(), g = words.FindNumber();
    const std::optional<double> b = words.FindNumber();
    if (!r || !g || !b) return;
    colors_.resize(model_.mesh.vertices.size() - 1, Eigen::Vector3f::Ones());
    Vector3d color = Vector3d(*r, *g, *b).cwiseMax(0).cwiseMin(1);
    for (double& channel : color) channel = LinearFromSrgb(channel);
    colors_.push_back(color.cast<float>());
  }
  // Of a triangle's corners together.
  Vector3d MeanColor(const Eigen::Vector3i& triangle) const {
    Vector3d mean = Vector3d::Zero();
    for (const int corner : triangle) {
      const bool colored = static_cast<size_t>(corner) < colors_.size();
      mean += colored ? Vector3d(colors_[corner].cast<double>()) : Vector3d(Vector3d::Ones());
    }
    return mean / 3;
  }

  void ReadComment(const std::string& line) {
    const std::optional<UnitComment> comment = ReadUnitComment(line);
    if (!comment || model_.metres_per_unit) return;
    model_.metres_per_unit = comment->metres;
    model_.warnings.push_back(
        InputError(path_,
                   "its comment " + Quoted(comment->text) +
                       (comment->metres ? " is taken as its unit" : " names no unit that is known"))
            .what());
  }

  void Skip(const std::string& keyword) {
    const bool line_or_point = keyword == "l" || keyword == "p";
    ++model_.entities[keyword.substr(0, 20)];
    ++model_.skipped[{keyword.substr(0, 20),
                      line_or_point ? "a line or point, no surface"
                                    : "no polygon: free-form and other statements are not read"}];
  }

  // A normal that is none is passed over; its faces have their own.
  void AddNormal(ObjWords& words) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const double x = words.FindNumber().value_or(kNone), y = words.FindNumber().value_or(kNone);
    const Vector3d normal(x, y, words.FindNumber().value_or(kNone));
    const bool valid = normal.allFinite() && normal.norm() > 0;
    if (!valid) ++model_.skipped[{"vn", "no direction: its faces have their own normal"}];
    normals_.push_back(valid ? Eigen::Vector3f(normal.normalized().cast<float>())
                             : Eigen::Vector3f(Eigen::Vector3f::Zero()));
  }

  // One name, with blanks or without, or several.
  void ReadLibraries(const std::string& names) {
    if (FindReference(path_, names)) return ReadLibrary(names);
    ObjWords words(path_, 0, names);
    while (const auto name = words.Next()) {
      if (!FindReference(path_, std::string(*name))) return ReadLibrary(names);
      ReadLibrary(std::string(*name));
    }
  }

  void ReadLibrary(const std::string& name) {
    const std::optional<fs::path> file = FindReference(path_, name);
    if (!file) {
      model_.warnings.push_back(
          InputError(path_, "its material file " + name + " is not there: its colours are unknown")
              .what());
      return;
    }
    for (auto& [material, values] : ReadObjMaterials(*file, &model_.skipped)) {
      materials_[material] = values;
    }
    surface_.reset();
  }

  struct Corner {
    int vertex;
    std::optional<int> uv, normal;
  };

  // From 1, or from the end if negative.
  static int Index(const ObjWords& words, std::string_view text, size_t count, const char* what) {
    int64_t index = 0;
    if (!ObjWords::ParseAll(text, &index)) {
      throw words.Error("\"" + std::string(text.substr(0, 40)) + "\", expected the number of a " +
                        what);
    }
    const auto size = static_cast<int64_t>(count);
    const int64_t from_zero = index > 0 ? index - 1 : size + index;
    if (index == 0 || from_zero < 0 || from_zero >= size) {
      throw words.Error("a face names " + std::string(what) + " " + std::to_string(index) +
                        ", expected 1 to " + std::to_string(size));
    }
    return static_cast<int>(from_zero);
  }

  Corner CornerOf(const ObjWords& words, std::string_view word) const {
    const size_t first = std::min(word.find('/'), word.size());
    const std::string_view rest = word.substr(std::min(first + 1, word.size()));
    const size_t second = std::min(rest.find('/'), rest.size());
    const std::string_view uv = rest.substr(0, second);
    const std::string_view normal = rest.substr(std::min(second + 1, rest.size()));
    Corner corner{
        Index(words, word.substr(0, first), model_.mesh.vertices.size(), "vertex"), {}, {}};
    if (!uv.empty()) corner.uv = Index(words, uv, uvs_.size(), "texture coordinate");
    if (!normal.empty()) corner.normal = Index(words, normal, normals_.size(), "normal");
    return corner;
  }

  void AddFace(ObjWords& words) {
    std::vector<Corner> corners;
    for (auto word = words.Next(); word && !word->starts_with('#'); word = words.Next()) {
      corners.push_back(CornerOf(words, *word));
    }
    if (corners.size() < 3) {
      ++model_.entities["f"];
      ++model_.skipped[{"f", "a face of fewer than 3 corners"}];
      return;
    }
    if (corners.size() > kMostCorners) throw words.Error("a face has over 10000 corners");
    ++model_.entities["f"];
    std::vector<int> vertices;
    for (const Corner& corner : corners) vertices.push_back(corner.vertex);
    const auto triangles = FaceTriangles(model_.mesh.vertices, vertices);
    if (triangles.empty()) ++model_.degenerate_faces;
    for (const Eigen::Vector3i& triangle : triangles) AddTriangle(triangle, corners);
  }

  void AddTriangle(const Eigen::Vector3i& triangle, const std::vector<Corner>& corners) {
    ModelMesh& mesh = model_.mesh;
    if (!surface_) surface_ = Surface();
    const Vector3d& a = mesh.vertices[triangle[0]];
    const Eigen::Vector3f facet = (mesh.vertices[triangle[1]] - a)
                                      .cross(mesh.vertices[triangle[2]] - a)
                                      .normalized()
                                      .cast<float>();
    mesh.triangles.push_back(triangle);
    mesh.surface_of_triangle.push_back(
        colors_.empty() ? *surface_ : builder_.ColoredSurface(*surface_, MeanColor(triangle)));
    if (uvs_.empty() && normals_.empty()) return;
    mesh.corner_uvs.resize(3 * mesh.triangles.size() - 3, Eigen::Vector2f(0, 0));
    FillNormals(mesh.triangles.size() - 1);
    for (const int vertex : triangle) {
      const auto corner = std::ranges::find(corners, vertex, &Corner::vertex);
      mesh.corner_uvs.push_back(corner->uv ? uvs_[*corner->uv] : Eigen::Vector2f(0, 0));
      const bool has_normal = corner->normal && normals_[*corner->normal].norm() > 0.5f;
      mesh.corner_normals.push_back(has_normal ? normals_[*corner->normal] : facet);
    }
  }

  // Faces before the first normal of the file have their own.
  void FillNormals(size_t triangles) {
    ModelMesh& mesh = model_.mesh;
    for (size_t t = mesh.corner_normals.size() / 3; t < triangles; ++t) {
      const Eigen::Vector3i& corners = mesh.triangles[t];
      const Vector3d& a = mesh.vertices[corners[0]];
      const Vector3d normal =
          (mesh.vertices[corners[1]] - a).cross(mesh.vertices[corners[2]] - a).normalized();
      mesh.corner_normals.insert(mesh.corner_normals.end(), 3, normal.cast<float>());
    }
  }

  int Surface() {
    SurfaceNames names;
    names.layer = object_.empty() || group_.empty() ? object_ + group_ : object_ + "/" + group_;
    if (names.layer.empty()) names.layer = path_.stem().string();
    names.material = material_;
    const auto found = materials_.find(material_);
    if (found != materials_.end()) {
      names.rgb = found->second.rgb;
      names.opacity = found->second.opacity;
      names.texture = found->second.texture;
      names.texture_place = found->second.texture_place;
    }
    return builder_.SurfaceOf(names);
  }

  fs::path path_;
  Model model_;
  MeshBuilder builder_;
  std::vector<Eigen::Vector2f> uvs_;
  std::vector<Eigen::Vector3f> normals_;
  std::map<std::string, ObjMaterial> materials_;
  std::string object_, group_, material_;
  std::optional<int> surface_;
  std::vector<Eigen::Vector3f>
      colors_;  // linear Rec. 709, of vertices; empty, or as many as have one
};

}  // namespace

Model ReadObj(const fs::path& path) { return ObjReader(path).Read(); }

}  // namespace insitu
