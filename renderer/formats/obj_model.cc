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
#include "renderer/foreign/unit_comment.h"
#include "renderer/formats/obj_material.h"
#include "renderer/formats/obj_words.h"
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
    if (keyword == "v" || keyword.starts_with("vt") || keyword == "vn" || keyword == "f" ||
        keyword == "fo") {
      words.CutComment();
    }
    if (keyword == "v") {
      AddVertex(words);
    } else if (keyword == "vt") {
      const std::optional<double> u = words.FindNumber(), v = words.FindNumber();
      if (!u) ++model_.skipped[{"vt", "no number: taken as 0"}];
      uvs_.emplace_back(static_cast<float>(u.value_or(0)), static_cast<float>(v.value_or(0)));
    } else if (keyword == "vn") {
      AddNormal(words);
    } else if (keyword == "f" || keyword == "fo") {  // fo: of old programs
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

  // One that is no point is passed over, with the faces at it: numbers of others stay right.
  void AddVertex(ObjWords& words) {
    model_.mesh.vertices.push_back(words.Point());
    const bool is_point = model_.mesh.vertices.back().allFinite();
    if (!is_point) ++model_.skipped[{"v", "no number: no point"}];
    all_points_ = all_points_ && is_point;
    AddColor(words);
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
    model_.warnings.push_back(InputError(path_, UnitNote(*comment)).what());
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
    names_library_ = true;
    if (const auto file = FindReference(path_, names)) return ReadLibrary(*file);
    std::vector<std::string> lost;
    for (const std::string& name : SeveralNames(names)) {
      if (const auto file = FindReference(path_, name)) {
        ReadLibrary(*file);
      } else {
        lost.push_back(name);
      }
    }
    if (lost.size() == SeveralNames(names).size()) return ReadLibraryBeside(names);
    for (const std::string& name : lost) SayLost(name, "its colours are unknown");
  }

  // "a.mtl b.mtl", in quotes where they hold blanks.
  static std::vector<std::string> SeveralNames(const std::string& text) {
    std::vector<std::string> names(1);
    bool in_quotes = false;
    for (const char c : text) {
      if (c == '"') in_quotes = !in_quotes;
      if (!in_quotes && (c == ' ' || c == '\t') && !names.back().empty()) names.emplace_back();
      if (c != '"' && (in_quotes || (c != ' ' && c != '\t'))) names.back() += c;
    }
    if (names.back().empty()) names.pop_back();
    return names;
  }

  void SayLost(const std::string& name, const std::string& so) {
    model_.warnings.push_back(
        InputError(path_, "its material file " + name + " is not there: " + so).what());
  }

  // The one called like the model, in the place of one that is not there.
  void ReadLibraryBeside(const std::string& name) {
    const auto beside = FindReference(path_, path_.stem().string() + ".mtl");
    if (!beside && !name.empty()) SayLost(name, "its colours are unknown");
    if (!beside) return;
    const std::string taken = beside->filename().string() + " beside it is taken";
    if (!name.empty()) {
      SayLost(name, taken);
    } else {
      model_.warnings.push_back(InputError(path_, "names no material file: " + taken).what());
    }
    ReadLibrary(*beside);
  }

  void ReadLibrary(const fs::path& file) {
    model_.files.push_back(file);
    for (auto& [material, values] : ReadObjMaterials(file, &model_.skipped)) {
      name_of_key_.try_emplace(NameKey(material), material);
      materials_[material] = values;
    }
    surface_.reset();
  }

  struct Corner {
    int vertex;
    std::optional<int> uv, normal;
  };

  // From 1, or from the end if negative; nullopt: none such.
  static std::optional<int> IndexIn(std::string_view text, size_t count) {
    int64_t index = 0;
    if (!ObjWords::ParseAll(text, &index)) return std::nullopt;
    const auto size = static_cast<int64_t>(count);
    const int64_t from_zero = index > 0 ? index - 1 : size + index;
    if (index == 0 || from_zero < 0 || from_zero >= size) return std::nullopt;
    return static_cast<int>(from_zero);
  }
  static int Vertex(const ObjWords& words, std::string_view text, size_t count) {
    if (const auto index = IndexIn(text, count)) return *index;
    int64_t number = 0;
    if (!ObjWords::ParseAll(text, &number)) {
      throw words.Error("\"" + std::string(text.substr(0, 40)) +
                        "\", expected the number of a vertex");
    }
    throw words.Error("a face names vertex " + std::to_string(number) + ", expected 1 to " +
                      std::to_string(count));
  }
  std::optional<int> Attribute(std::string_view text, size_t count, const char* kind) {
    if (text.empty()) return std::nullopt;
    const auto index = IndexIn(text, count);
    if (!index) ++model_.skipped[{kind, "named by corners of faces and not there"}];
    return index;
  }

  Corner CornerOf(const ObjWords& words, std::string_view word) {
    const size_t first = std::min(word.find('/'), word.size());
    const std::string_view rest = word.substr(std::min(first + 1, word.size()));
    const size_t second = std::min(rest.find('/'), rest.size());
    const std::string_view uv = rest.substr(0, second);
    const std::string_view normal = rest.substr(std::min(second + 1, rest.size()));
    return {Vertex(words, word.substr(0, first), model_.mesh.vertices.size()),
            Attribute(uv, uvs_.size(), "vt"), Attribute(normal, normals_.size(), "vn")};
  }

  void AddFace(ObjWords& words) {
    std::vector<Corner> corners;
    for (auto word = words.Next(); word; word = words.Next()) {
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
    const auto is_point = [&](int v) { return model_.mesh.vertices[v].allFinite(); };
    if (!all_points_ && !std::ranges::all_of(vertices, is_point)) {
      ++model_.skipped[{"f", "a face at a vertex that is no point"}];
      return;
    }
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
    if (!names_library_ && !material_.empty()) {
      names_library_ = true;
      ReadLibraryBeside("");
    }
    auto found = materials_.find(material_);
    if (found == materials_.end()) {  // names that differ in case alone
      const auto alike = name_of_key_.find(NameKey(material_));
      if (alike != name_of_key_.end()) found = materials_.find(alike->second);
    }
    if (found != materials_.end()) {
      names.rgb = found->second.rgb;
      names.opacity = found->second.opacity;
      names.texture = found->second.texture;
      names.texture_place = found->second.texture_place;
      names.maps = found->second.maps;
    }
    return builder_.SurfaceOf(names);
  }

  fs::path path_;
  Model model_;
  MeshBuilder builder_;
  std::vector<Eigen::Vector2f> uvs_;
  std::vector<Eigen::Vector3f> normals_;
  std::map<std::string, ObjMaterial> materials_;
  std::map<std::string, std::string> name_of_key_;  // of their names
  bool names_library_ = false, all_points_ = true;
  std::string object_, group_, material_;
  std::optional<int> surface_;
  std::vector<Eigen::Vector3f>
      colors_;  // linear Rec. 709, of vertices; empty, or as many as have one
};

}  // namespace

Model ReadObj(const fs::path& path) { return ObjReader(path).Read(); }

}  // namespace insitu
