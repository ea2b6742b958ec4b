// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/obj_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "calibration/files/error.h"
#include "renderer/dxf/dxf_name.h"
#include "renderer/formats/file_reference.h"
#include "renderer/formats/text_lines.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double kLargestNumber = 1e12;

// Words of a line, blanks between.
class Words {
 public:
  Words(const fs::path& path, int line, std::string_view text)
      : path_(path), line_(line), rest_(text) {}

  std::optional<std::string_view> Next() {
    const size_t first = rest_.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return std::nullopt;
    const size_t end = std::min(rest_.find_first_of(" \t\r", first), rest_.size());
    const std::string_view word = rest_.substr(first, end - first);
    rest_.remove_prefix(end);
    return word;
  }
  std::string Rest() {
    const size_t first = rest_.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return "";
    return std::string(rest_.substr(first, rest_.find_last_not_of(" \t\r") - first + 1));
  }
  // The rest as a name; bytes that are no UTF-8 are Windows-1252.
  std::string Name() { return Utf8FromDxf(Rest()); }
  // nullopt: no number, not finite, beyond any; the word is passed over.
  std::optional<double> FindNumber() {
    const auto word = Next();
    double value = 0;
    if (!word || !ParseAll(*word, &value) || !(std::abs(value) <= kLargestNumber)) {
      return std::nullopt;
    }
    return value;
  }
  double Number() {
    const auto word = Next();
    double value = 0;
    if (!word || !ParseAll(*word, &value) || !(std::abs(value) <= kLargestNumber)) {
      throw Error((word ? "\"" + std::string(word->substr(0, 40)) + "\"" : "the line ends") +
                  ", expected a number of at most 1e12");
    }
    return value;
  }
  Vector3d Point() {
    const double x = Number(), y = Number();
    return {x, y, Number()};
  }
  InputError Error(const std::string& message) const { return {path_, line_, message}; }

  template <typename T>
  static bool ParseAll(std::string_view word, T* value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), *value);
    return status == std::errc() && end == word.data() + word.size();
  }

 private:
  const fs::path& path_;
  int line_;
  std::string_view rest_;
};

// Calls `use` with the words of each line; a backslash at its end continues it.
template <typename Use>
void ForEachLine(const fs::path& path, const Use& use) {
  TextLines lines(path);
  std::string line, more;
  for (int number = 1; lines.Next(&line); ++number) {
    const int first = number;
    while (line.ends_with('\\')) {
      line.pop_back();
      if (!lines.Next(&more)) break;
      line += " " + more;
      ++number;
    }
    Words words(path, first, line);
    const auto keyword = words.Next();
    if (keyword && keyword->front() != '#') use(*keyword, words, first);
  }
}

struct ObjMaterial {
  std::optional<Vector3d> rgb;
  double opacity = 1;
  std::string texture, texture_place;
};

// The image comes last, after options; its name may hold blanks.
std::string TextureName(Words words) {
  for (auto option = Words(words).Next(); option && option->starts_with('-');) {
    words.Next();
    const bool up_to_three = *option == "-o" || *option == "-s" || *option == "-t";
    const int most = up_to_three ? 3 : *option == "-mm" ? 2 : 1;
    double number = 0;
    for (int i = 0; i < most; ++i) {
      const auto value = Words(words).Next();
      if (!value || (up_to_three && !Words::ParseAll(*value, &number))) break;
      words.Next();
    }
    option = Words(words).Next();
  }
  return words.Name();
}

// "Kd r" means r r r; nullopt: "spectral" or "xyz", or no number.
std::optional<Vector3d> ColorOf(Words words) {
  const std::optional<double> r = words.FindNumber();
  if (!r) return std::nullopt;
  const std::optional<double> g = words.FindNumber(), b = words.FindNumber();
  const Vector3d color(*r, g.value_or(*r), b.value_or(g.value_or(*r)));
  return color.cwiseMax(0).cwiseMin(1);
}

// One material file. "d" goes before "Tr": programs write both alike, and d is the defined one.
class MaterialsReader {
 public:
  MaterialsReader(const fs::path& path, SkippedEntities* skipped)
      : path_(path), skipped_(skipped) {}

  std::map<std::string, ObjMaterial> Read() {
    ForEachLine(path_, [this](std::string_view keyword, Words& words, int line) {
      if (keyword == "newmtl") {
        current_ = &materials_[words.Name()];
        has_dissolve_ = false;
      } else if (current_) {
        ReadLine(keyword, words, line);
      }
    });
    return std::move(materials_);
  }

 private:
  void ReadLine(std::string_view keyword, Words& words, int line) {
    if (keyword == "Kd") {
      current_->rgb = ColorOf(words);
      if (!current_->rgb) Skip("Kd", "a colour that is no number: shown in mid grey");
    } else if (keyword == "d" || keyword == "Tr") {
      ReadOpacity(keyword == "d", words);
    } else if (keyword == "map_Kd") {
      current_->texture = TextureName(words);
      current_->texture_place = path_.string() + ":" + std::to_string(line);
    }
  }
  void ReadOpacity(bool is_dissolve, Words words) {
    const auto first = Words(words).Next();
    if (first && *first == "-halo") words.Next();
    const std::optional<double> value = words.FindNumber();
    if (!value) return Skip(is_dissolve ? "d" : "Tr", "no number: taken as opaque");
    if (!is_dissolve && has_dissolve_) return;
    has_dissolve_ |= is_dissolve;
    current_->opacity = std::clamp(is_dissolve ? *value : 1 - *value, 0.0, 1.0);
  }
  void Skip(const char* kind, const char* reason) { ++(*skipped_)[{kind, reason}]; }

  fs::path path_;
  SkippedEntities* skipped_;
  std::map<std::string, ObjMaterial> materials_;
  ObjMaterial* current_ = nullptr;
  bool has_dissolve_ = false;
};

class ObjReader {
 public:
  explicit ObjReader(const fs::path& path) : path_(path), index_(&model_.mesh.surfaces) {
    model_.format = "OBJ";
  }

  Model Read() {
    ForEachLine(path_,
                [this](std::string_view keyword, Words& words, int) { ReadLine(keyword, words); });
    if (has_vertex_colors_) model_.skipped[{"colour by vertex", "not shown"}] = 1;
    if (uvs_.empty()) model_.mesh.corner_uvs.clear();
    if (normals_.empty()) model_.mesh.corner_normals.clear();
    DropUnused(&model_.mesh);
    return std::move(model_);
  }

 private:
  void ReadLine(std::string_view keyword, Words& words) {
    ModelMesh& mesh = model_.mesh;
    if (keyword == "v") {
      mesh.vertices.push_back(words.Point());
      has_vertex_colors_ |= words.Next() && words.Next() && words.Next();  // not x y z w
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

  void Skip(const std::string& keyword) {
    const bool line_or_point = keyword == "l" || keyword == "p";
    ++model_.entities[keyword.substr(0, 20)];
    ++model_.skipped[{keyword.substr(0, 20),
                      line_or_point ? "a line or point, no surface"
                                    : "no polygon: free-form and other statements are not read"}];
  }

  // A normal that is none is passed over; its faces have their own.
  void AddNormal(Words& words) {
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
    Words words(path_, 0, names);
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
    for (auto& [material, values] : MaterialsReader(*file, &model_.skipped).Read()) {
      materials_[material] = values;
    }
    surface_.reset();
  }

  struct Corner {
    int vertex;
    std::optional<int> uv, normal;
  };

  // From 1, or from the end if negative.
  static int Index(const Words& words, std::string_view text, size_t count, const char* what) {
    int64_t index = 0;
    if (!Words::ParseAll(text, &index)) {
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

  Corner CornerOf(const Words& words, std::string_view word) const {
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

  void AddFace(Words& words) {
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
    mesh.surface_of_triangle.push_back(*surface_);
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
    return index_.IndexOf(names);
  }

  fs::path path_;
  Model model_;
  SurfaceIndex index_;
  std::vector<Eigen::Vector2f> uvs_;
  std::vector<Eigen::Vector3f> normals_;
  std::map<std::string, ObjMaterial> materials_;
  std::string object_, group_, material_;
  std::optional<int> surface_;
  bool has_vertex_colors_ = false;
};

}  // namespace

Model ReadObj(const fs::path& path) { return ObjReader(path).Read(); }

}  // namespace insitu
