// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/collada_geometry.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include "calibration/files/wording.h"
#include "renderer/foreign/collada_library.h"

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::optional<int> WholeAttribute(const XmlNode& node, const char* name) {
  if (!node.Attribute(name)) return std::nullopt;
  const double value = node.NumberAttribute(name);
  constexpr double kMost = 2e9;
  if (value < 0 || value > kMost) throw node.Error(std::string(name) + " is out of range");
  return static_cast<int>(value);
}

// Rows of up to three numbers, by the params that have a name.
std::vector<Vector3d> RowsOfSource(const XmlNode& source, int* faulty) {
  const XmlNode accessor = source.At("technique_common").At("accessor");
  const auto array = source.Find("float_array");
  if (!array) throw source.Error("holds no float_array");
  const std::vector<double> numbers = ColladaNumbers(*array, faulty);
  const size_t stride = std::max(WholeAttribute(accessor, "stride").value_or(1), 1);
  const size_t offset = WholeAttribute(accessor, "offset").value_or(0);
  const size_t stated = WholeAttribute(accessor, "count").value_or(0);
  std::vector<size_t> columns;
  const std::vector<XmlNode> params = accessor.Children("param");
  for (size_t i = 0; i < params.size(); ++i) {
    if (params[i].Attribute("name") || params.size() <= 3) columns.push_back(i);
  }
  const size_t held = numbers.size() > offset ? (numbers.size() - offset) / stride : 0;
  if (held < stated) {
    throw array->Error("holds " + std::to_string(held) + " rows, expected " +
                       std::to_string(stated) + " as its accessor states: it is cut short");
  }
  std::vector<Vector3d> rows(stated, Vector3d::Zero());
  for (size_t r = 0; r < stated; ++r) {
    for (size_t c = 0; c < std::min<size_t>(columns.size(), 3); ++c) {
      if (columns[c] < stride)
        rows[r][static_cast<int>(c)] = numbers[offset + r * stride + columns[c]];
    }
  }
  return rows;
}

class ColladaGeometryReader {
 public:
  ColladaGeometryReader(const XmlNode& mesh, Model* model) : mesh_(mesh), model_(*model) {
    for (const XmlNode& source : mesh.Children("source")) {
      if (const auto id = source.Attribute("id")) sources_.try_emplace("#" + *id, source);
    }
  }

  ColladaGeometry Read() {
    ReadVertices();
    for (const XmlNode& part : mesh_.Children()) {
      const std::string kind = part.Name();
      if (kind == "lines" || kind == "linestrips") {
        ++model_.skipped[{kind, "no surface"}];
      } else if (kind == "triangles" || kind == "polylist" || kind == "polygons" ||
                 kind == "tristrips" || kind == "trifans") {
        ReadPart(part, kind);
      } else if (kind != "source" && kind != "vertices" && kind != "extra") {
        ++model_.skipped[{kind.substr(0, 40), "no faces that are read"}];
      }
    }
    return std::move(geometry_);
  }

 private:
  // Where the numbers of one kind stand among those of a corner.
  struct Input {
    int offset = 0;
    std::vector<Vector3d> rows;
  };

  void ReadVertices() {
    const XmlNode vertices = mesh_.At("vertices");
    for (const XmlNode& input : vertices.Children("input")) {
      const std::string semantic = input.RequiredAttribute("semantic");
      std::vector<Vector3d> rows = Rows(input);
      if (semantic == "POSITION") {
        geometry_.positions = std::move(rows);
      } else {
        by_vertex_[semantic] = std::move(rows);
      }
    }
  }

  std::vector<Vector3d> Rows(const XmlNode& input) {
    const std::string url = input.RequiredAttribute("source");
    const auto source = sources_.find(url);
    if (source == sources_.end()) {
      const std::string semantic = input.Attribute("semantic").value_or("");
      if (semantic == "POSITION")
        throw input.Error("names " + Quoted(url) + ", which is no source");
      ++model_.skipped[{semantic.substr(0, 20), "its source is not there"}];
      return {};
    }
    int faulty = 0;
    std::vector<Vector3d> rows = RowsOfSource(source->second, &faulty);
    if (faulty == 0) return rows;
    if (input.Attribute("semantic") == "POSITION") {
      throw source->second.Error("holds a position that is no number");
    }
    model_.skipped[{"number of " + input.Attribute("semantic").value_or(""), "no number"}] +=
        faulty;
    return rows;
  }

  void ReadPart(const XmlNode& node, const std::string& kind) {
    ColladaPart part;
    part.material = node.Attribute("material").value_or("");
    inputs_.clear();
    stride_ = 1;
    for (const XmlNode& input : node.Children("input")) AddInput(input);
    if (!inputs_.contains("VERTEX")) {
      if (node.Children("p").empty()) return;  // an empty part has no inputs
      throw node.Error("has no input VERTEX");
    }
    part.normals = RowsFor("NORMAL");
    part.colors = RowsFor("COLOR");
    for (const Vector3d& row : RowsFor("TEXCOORD")) part.uvs.emplace_back(row.head<2>());
    AddFaces(node, kind, &part);
    const int lost =
        WholeAttribute(node, "count").value_or(0) - static_cast<int>(part.faces.size());
    const bool is_counted = kind == "triangles" || kind == "polylist" || kind == "polygons";
    if (is_counted && lost > 0)
      model_.skipped[{"face", "stated by its count and not there"}] += lost;
    geometry_.parts.push_back(std::move(part));
  }

  void AddInput(const XmlNode& input) {
    const std::string semantic = input.RequiredAttribute("semantic");
    const int offset = WholeAttribute(input, "offset").value_or(0);
    constexpr int kMostOffset = 1000;
    if (offset > kMostOffset) throw input.Error("an offset beyond 1000");
    stride_ = std::max(stride_, offset + 1);
    const bool is_read = semantic == "VERTEX" || semantic == "NORMAL" || semantic == "COLOR" ||
                         semantic == "TEXCOORD";
    if (!is_read) return;  // tangents serve normal maps alone
    if (inputs_.contains(semantic)) {
      ++model_.skipped[{"second " + semantic, "only the first is read"}];
      return;
    }
    inputs_[semantic] = {offset, semantic == "VERTEX" ? std::vector<Vector3d>() : Rows(input)};
  }

  // Those of the corners, else those of the vertices.
  std::vector<Vector3d> RowsFor(const std::string& semantic) {
    const auto own = inputs_.find(semantic);
    if (own != inputs_.end()) return own->second.rows;
    const auto shared = by_vertex_.find(semantic);
    return shared == by_vertex_.end() ? std::vector<Vector3d>() : shared->second;
  }

  void AddFaces(const XmlNode& node, const std::string& kind, ColladaPart* part) {
    const std::vector<XmlNode> lists = node.Children("p");
    if (kind == "polylist") {
      if (lists.empty()) return;
      AddPolylist(node, CornersOf(lists[0], *part), part);
      return;
    }
    for (const XmlNode& list : lists) AddList(kind, CornersOf(list, *part), part);
    for (const XmlNode& holed : node.Children("ph")) {
      ColladaFace face{CornersOf(holed.At("p"), *part), {}};
      for (const XmlNode& hole : holed.Children("h")) {
        face.holes.push_back(CornersOf(hole, *part));
      }
      part->faces.push_back(std::move(face));
    }
  }

  void AddPolylist(const XmlNode& node, const std::vector<ColladaCorner>& corners,
                   ColladaPart* part) {
    size_t next = 0;
    for (const int count : ColladaIndices(node.At("vcount"))) {
      if (count < 0 || next + count > corners.size()) {
        throw node.Error("has " + std::to_string(corners.size()) +
                         " corners, fewer than its vcount states: it is cut short");
      }
      const auto first = corners.begin() + static_cast<std::ptrdiff_t>(next);
      part->faces.push_back({{first, first + count}, {}});
      next += count;
    }
  }

  void AddList(const std::string& kind, const std::vector<ColladaCorner>& corners,
               ColladaPart* part) {
    if (kind == "polygons") {
      part->faces.push_back({corners, {}});
      return;
    }
    const size_t step = kind == "triangles" ? 3 : 1;
    if (step == 3 && corners.size() % 3 != 0) {
      ++model_.skipped[{"corners", "too few for a last triangle"}];
    }
    for (size_t i = 0; i + 2 < corners.size(); i += step) {
      const bool turned = kind == "tristrips" && i % 2 == 1;
      part->faces.push_back({{corners[kind == "trifans" ? 0 : i], corners[turned ? i + 2 : i + 1],
                              corners[turned ? i + 1 : i + 2]},
                             {}});
    }
  }

  std::vector<ColladaCorner> CornersOf(const XmlNode& list, const ColladaPart& part) const {
    const std::vector<int> indices = ColladaIndices(list);
    std::vector<ColladaCorner> corners;
    corners.reserve(indices.size() / stride_);
    const auto index = [&](size_t first, const char* semantic, int vertex, size_t count) {
      if (count == 0) return -1;
      const auto input = inputs_.find(semantic);
      const int value = input == inputs_.end() ? vertex : indices[first + input->second.offset];
      if (value >= 0 && static_cast<size_t>(value) < count) return value;
      if (std::string_view(semantic) != "VERTEX") {
        ++model_.skipped[{semantic, "named by corners of faces and not there"}];
        return -1;
      }
      throw list.Error("names " + std::string(semantic) + " " + std::to_string(value) +
                       ", expected 0 to " + std::to_string(count - 1));
    };
    for (size_t i = 0; i + stride_ <= indices.size(); i += stride_) {
      ColladaCorner corner;
      corner.position = index(i, "VERTEX", 0, geometry_.positions.size());
      if (corner.position < 0) throw list.Error("names a vertex, but there is no position");
      corner.normal = index(i, "NORMAL", corner.position, part.normals.size());
      corner.uv = index(i, "TEXCOORD", corner.position, part.uvs.size());
      corner.color = index(i, "COLOR", corner.position, part.colors.size());
      corners.push_back(corner);
    }
    return corners;
  }

  const XmlNode& mesh_;
  Model& model_;
  std::map<std::string, XmlNode> sources_;
  std::map<std::string, std::vector<Vector3d>> by_vertex_;
  std::map<std::string, Input> inputs_;
  int stride_ = 1;
  ColladaGeometry geometry_;
};

}  // namespace

ColladaGeometry ReadColladaGeometry(const XmlNode& geometry, Model* model) {
  auto mesh = geometry.Find("mesh");
  if (!mesh) mesh = geometry.Find("convex_mesh");
  if (!mesh || !mesh->Find("vertices")) {
    ++model->skipped[{"geometry that is no mesh", "splines and breps are not read"}];
    return {};
  }
  return ColladaGeometryReader(*mesh, model).Read();
}

}  // namespace insitu
