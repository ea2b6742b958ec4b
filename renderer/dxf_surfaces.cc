// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf_surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>

#include "renderer/dxf_block.h"
#include "renderer/face_triangles.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

// Adds the vertices of one entity and returns the index of the first.
int AddVertices(const std::vector<Vector3d>& vertices, DxfModel* model) {
  std::vector<Vector3d>& all = model->mesh.vertices;
  const int first = static_cast<int>(all.size());
  all.insert(all.end(), vertices.begin(), vertices.end());
  return first;
}

int LayerIndex(const std::string& name, LayeredMesh* mesh) {
  const auto found = std::ranges::find(mesh->layers, name);
  const int index = static_cast<int>(found - mesh->layers.begin());
  if (found == mesh->layers.end()) mesh->layers.push_back(name);
  return index;
}

// `corners` count from vertex `first` of the model's mesh.
void AddFace(const std::string& layer, int first, std::vector<int> corners, DxfModel* model) {
  for (int& corner : corners) corner += first;
  LayeredMesh& mesh = model->mesh;
  const std::vector<Eigen::Vector3i> triangles = FaceTriangles(mesh.vertices, corners);
  if (triangles.empty()) {
    ++model->degenerate_faces;
    return;
  }
  mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  mesh.layer_of_triangle.resize(mesh.triangles.size(), LayerIndex(layer, &mesh));
}

std::string LayerOf(const DxfRecord& entity) { return entity.Name(8, "0"); }

// The values of a MESH come in a fixed order; this walks through them.
class TagWalk {
 public:
  explicit TagWalk(const DxfRecord& entity) : entity_(entity), rest_(entity.tags()) {}

  void SkipTo(int code, std::string_view value) {
    SkipUntil([&](const DxfTag& tag) { return tag.code == code && tag.value == value; });
  }
  void SkipTo(int code) {
    SkipUntil([&](const DxfTag& tag) { return tag.code == code; });
  }
  // The next tag, which must carry this code.
  const DxfTag& Next(int code) {
    if (rest_.empty()) throw Missing(last_, code);
    if (rest_.front().code != code) throw Missing(rest_.front(), code);
    last_ = rest_.front();
    rest_ = rest_.subspan(1);
    return last_;
  }

 private:
  template <typename Predicate>
  void SkipUntil(Predicate found) {
    while (!rest_.empty() && !found(rest_.front())) {
      last_ = rest_.front();
      rest_ = rest_.subspan(1);
    }
  }
  InputError Missing(const DxfTag& at, int code) const {
    return entity_.ErrorAt(at, std::string(entity_.kind()) + " goes on otherwise than its counts " +
                                   "say, expected group code " + std::to_string(code));
  }

  const DxfRecord& entity_;
  std::span<const DxfTag> rest_;
  DxfTag last_{};
};

std::vector<Vector3d> MeshVertices(const DxfRecord& entity, TagWalk* walk) {
  const int count = entity.IntegerOf(walk->Next(92));
  std::vector<Vector3d> vertices;
  for (int i = 0; i < count; ++i) {
    const double x = entity.NumberOf(walk->Next(10));
    const double y = entity.NumberOf(walk->Next(20));
    const double z = entity.NumberOf(walk->Next(30));
    vertices.emplace_back(x, y, z);
  }
  return vertices;
}

// One face of a MESH: the number of its corners, then their indices.
std::vector<int> MeshFace(const DxfRecord& entity, int vertices, TagWalk* walk) {
  const DxfTag count_tag = walk->Next(90);
  const int count = entity.IntegerOf(count_tag);
  if (count < 3) throw entity.ErrorAt(count_tag, "a face of a MESH has at least 3 corners");
  std::vector<int> corners;
  for (int i = 0; i < count; ++i) {
    const DxfTag& tag = walk->Next(90);
    corners.push_back(entity.IntegerOf(tag));
    if (corners.back() < 0 || corners.back() >= vertices) {
      throw entity.ErrorAt(tag, "a face names vertex " + std::to_string(corners.back()) +
                                    ", expected 0 to " + std::to_string(vertices - 1));
    }
  }
  return corners;
}

// Corners of a polyface's face record: 1-based, negative where the edge is invisible, 0 for none.
std::vector<int> PolyfaceCorners(const DxfRecord& face, int vertices) {
  std::vector<int> corners;
  for (int code = 71; code <= 74; ++code) {
    const DxfTag* tag = face.Find(code);
    const int64_t number = tag ? std::abs(int64_t{face.IntegerOf(*tag)}) : 0;
    if (number > vertices) {
      throw face.ErrorAt(*tag, "a face names vertex " + std::to_string(number) +
                                   ", expected 1 to " + std::to_string(vertices));
    }
    if (number != 0) corners.push_back(static_cast<int>(number) - 1);
  }
  return corners;
}

}  // namespace

void AddDxf3dFace(const DxfRecord& entity, DxfModel* model) {
  const Vector3d third = entity.Point(12);
  const int first = AddVertices(
      {entity.Point(10), entity.Point(11), third, entity.FindPoint(13).value_or(third)}, model);
  AddFace(LayerOf(entity), first, {0, 1, 2, 3}, model);
}

void AddDxfSolid(const DxfRecord& entity, DxfModel* model) {
  const Eigen::Matrix3d axes = DxfEntityAxes(entity);
  const Vector3d third = entity.Point(12);
  // The corners are stored crosswise: 1, 2, 4, 3 go round.
  std::vector<Vector3d> vertices = {entity.Point(10), entity.Point(11),
                                    entity.FindPoint(13).value_or(third), third};
  const Vector3d height(0, 0, entity.Number(39, 0));
  for (int i = 0; i < 4; ++i) vertices.push_back(vertices[i] + height);
  for (Vector3d& vertex : vertices) vertex = axes * vertex;
  const std::string layer = LayerOf(entity);
  if (height.z() == 0) {
    vertices.resize(4);
    AddFace(layer, AddVertices(vertices, model), {0, 1, 2, 3}, model);
    return;
  }
  const int first = AddVertices(vertices, model);
  AddFace(layer, first, {3, 2, 1, 0}, model);
  AddFace(layer, first, {4, 5, 6, 7}, model);
  for (int i = 0, next = 1; i < 4; ++i, next = (i + 1) % 4) {
    if (vertices[i] == vertices[next]) continue;  // a triangle's fourth corner is its third
    AddFace(layer, first, {i, next, next + 4, i + 4}, model);
  }
}

void AddDxfMesh(const DxfRecord& entity, DxfModel* model) {
  TagWalk walk(entity);
  walk.SkipTo(100, "AcDbSubDMesh");
  walk.SkipTo(92);
  const std::vector<Vector3d> vertices = MeshVertices(entity, &walk);
  const int first = AddVertices(vertices, model);
  const DxfTag size_tag = walk.Next(93);
  const int list_size = entity.IntegerOf(size_tag);
  int64_t read = 0;
  while (read < list_size) {
    const std::vector<int> corners = MeshFace(entity, static_cast<int>(vertices.size()), &walk);
    AddFace(LayerOf(entity), first, corners, model);
    read += static_cast<int64_t>(corners.size()) + 1;
  }
  if (read > list_size) {
    throw entity.ErrorAt(size_tag, "the faces of this MESH take " + std::to_string(read) +
                                       " numbers, not " + std::to_string(list_size));
  }
  if (entity.Integer(91, 0) > 0) ++model->smoothed_meshes;
}

void AddDxfPolyface(const DxfRecord& polyline, std::span<const DxfRecord> vertices,
                    DxfModel* model) {
  constexpr int kLocation = 64, kPolyface = 128;
  std::vector<Vector3d> locations;
  std::vector<const DxfRecord*> faces;
  for (const DxfRecord& vertex : vertices) {
    const int flags = vertex.Integer(70, 0);
    if (flags & kLocation) {
      locations.push_back(vertex.Point(10));
    } else if (flags & kPolyface) {
      faces.push_back(&vertex);
    }
  }
  const int first = AddVertices(locations, model);
  for (const DxfRecord* face : faces) {
    // Many programs leave the faces on layer 0.
    const std::string own_layer = LayerOf(*face);
    AddFace(own_layer == "0" ? LayerOf(polyline) : own_layer, first,
            PolyfaceCorners(*face, static_cast<int>(locations.size())), model);
  }
}

void AddDxfPolygonMesh(const DxfRecord& polyline, std::span<const DxfRecord> vertices,
                       DxfModel* model) {
  constexpr int kClosedAlongRows = 1, kSmoothed = 4, kClosedAlongColumns = 32;
  constexpr int kControlPoint = 16;  // of a smoothed mesh: not on its surface
  const int flags = polyline.Integer(70, 0);
  const bool smoothed = flags & kSmoothed;
  const int rows = polyline.Integer(smoothed ? 73 : 71, 0);
  const int columns = polyline.Integer(smoothed ? 74 : 72, 0);
  std::vector<Vector3d> grid;
  for (const DxfRecord& vertex : vertices) {
    if (!(vertex.Integer(70, 0) & kControlPoint)) grid.push_back(vertex.Point(10));
  }
  if (rows < 2 || columns < 2 || int64_t{rows} * columns != static_cast<int64_t>(grid.size())) {
    throw polyline.Error("a polygon mesh of " + std::to_string(rows) + " x " +
                         std::to_string(columns) + " vertices has " + std::to_string(grid.size()) +
                         " of them");
  }
  const int first = AddVertices(grid, model);
  const auto index = [&](int row, int column) { return row % rows * columns + column % columns; };
  const int row_count = flags & kClosedAlongRows ? rows : rows - 1;
  const int column_count = flags & kClosedAlongColumns ? columns : columns - 1;
  for (int m = 0; m < row_count; ++m) {
    for (int n = 0; n < column_count; ++n) {
      AddFace(LayerOf(polyline), first,
              {index(m, n), index(m + 1, n), index(m + 1, n + 1), index(m, n + 1)}, model);
    }
  }
}

}  // namespace insitu
