// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/mesh/face_mesh.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

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
  // The next tag if it carries this code.
  std::optional<DxfTag> NextIf(int code) {
    if (rest_.empty() || rest_.front().code != code) return std::nullopt;
    return Next(code);
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
  if (count > static_cast<int>(kMostCorners)) {
    throw entity.ErrorAt(count_tag, "a face of a MESH has over 10000 corners");
  }
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

// Edges that stay sharp: pairs of vertices, then a value each; -1 is for ever.
std::map<std::pair<int, int>, double> MeshCreases(const DxfRecord& entity, int vertices,
                                                  TagWalk* walk) {
  std::map<std::pair<int, int>, double> creases;
  const std::optional<DxfTag> count_tag = walk->NextIf(94);
  const int count = count_tag ? entity.IntegerOf(*count_tag) : 0;
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i < count; ++i) {
    int ends[2];
    for (int& end : ends) {
      const DxfTag tag = walk->Next(90);
      end = entity.IntegerOf(tag);
      if (end < 0 || end >= vertices) {
        throw entity.ErrorAt(tag, "an edge names vertex " + std::to_string(end) +
                                      ", expected 0 to " + std::to_string(vertices - 1));
      }
    }
    edges.emplace_back(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  }
  const std::optional<DxfTag> crease_tag = walk->NextIf(95);
  const int crease_count = crease_tag ? entity.IntegerOf(*crease_tag) : 0;
  for (int i = 0; i < crease_count; ++i) {
    const double value = entity.NumberOf(walk->Next(140));
    if (i < count && value != 0) creases[edges[i]] = value < 0 ? kFinestSmoothing + 1 : value;
  }
  return creases;
}

constexpr size_t kMostSmoothedFaces = 1000000;

}  // namespace

int AddDxfVertices(const std::vector<Vector3d>& vertices, DxfBlock* block) {
  std::vector<Vector3d>& all = block->vertices;
  const int first = static_cast<int>(all.size());
  all.insert(all.end(), vertices.begin(), vertices.end());
  return first;
}

void AddDxfFace(int look, int first, std::vector<int> corners, DxfBlock* block) {
  for (int& corner : corners) corner += first;
  const std::vector<Eigen::Vector3i> triangles = FaceTriangles(block->vertices, corners);
  if (triangles.empty()) ++block->degenerate_faces;
  block->triangles.insert(block->triangles.end(), triangles.begin(), triangles.end());
  block->look_of_triangle.resize(block->triangles.size(), look);
}

void AddDxf3dFace(const DxfRecord& entity, int look, DxfBlock* block) {
  const Vector3d third = entity.Point(12);
  const Vector3d fourth = entity.FindPoint(13).value_or(third);
  std::vector<Vector3d> vertices = {entity.Point(10), entity.Point(11), third};
  std::vector<int> corners = {0, 1, 2};
  if (fourth != third) {
    vertices.push_back(fourth);
    corners.push_back(3);
  }
  AddDxfFace(look, AddDxfVertices(vertices, block), corners, block);
}

void AddDxfSolid(const DxfRecord& entity, int look, DxfBlock* block) {
  const Eigen::Matrix3d axes = DxfEntityAxes(entity);
  const Vector3d third = entity.Point(12);
  // The corners are stored crosswise: 1, 2, 4, 3 go round.
  std::vector<Vector3d> vertices = {entity.Point(10), entity.Point(11),
                                    entity.FindPoint(13).value_or(third), third};
  const Vector3d height(0, 0, entity.Number(39, 0));
  for (int i = 0; i < 4; ++i) vertices.push_back(vertices[i] + height);
  for (Vector3d& vertex : vertices) vertex = axes * vertex;
  if (height.z() == 0) {
    vertices.resize(4);
    AddDxfFace(look, AddDxfVertices(vertices, block), {0, 1, 2, 3}, block);
    return;
  }
  const int first = AddDxfVertices(vertices, block);
  AddDxfFace(look, first, {3, 2, 1, 0}, block);
  AddDxfFace(look, first, {4, 5, 6, 7}, block);
  for (int i = 0, next = 1; i < 4; ++i, next = (i + 1) % 4) {
    if (vertices[i] == vertices[next]) continue;  // a triangle's fourth corner is its third
    AddDxfFace(look, first, {i, next, next + 4, i + 4}, block);
  }
}

void AddDxfMesh(const DxfRecord& entity, int look, DxfBlock* block) {
  TagWalk walk(entity);
  walk.SkipTo(100, "AcDbSubDMesh");
  walk.SkipTo(92);
  FaceMesh mesh;
  mesh.vertices = MeshVertices(entity, &walk);
  const DxfTag size_tag = walk.Next(93);
  const int list_size = entity.IntegerOf(size_tag);
  int64_t read = 0;
  while (read < list_size) {
    mesh.faces.push_back(MeshFace(entity, static_cast<int>(mesh.vertices.size()), &walk));
    read += static_cast<int64_t>(mesh.faces.back().size()) + 1;
  }
  if (read > list_size) {
    throw entity.ErrorAt(size_tag, "the faces of this MESH take " + std::to_string(read) +
                                       " numbers, not " + std::to_string(list_size));
  }
  mesh.creases = MeshCreases(entity, static_cast<int>(mesh.vertices.size()), &walk);
  const int level = std::clamp(entity.Integer(91, 0), 0, kFinestSmoothing);
  for (int i = 0; i < level && mesh.faces.size() < kMostSmoothedFaces; ++i) mesh = Smoothed(mesh);
  const int first = AddDxfVertices(mesh.vertices, block);
  for (std::vector<int>& face : mesh.faces) AddDxfFace(look, first, std::move(face), block);
}

std::vector<int> DxfPolyfaceCorners(const DxfRecord& face, int64_t vertices) {
  std::vector<int> corners;
  for (int code = 71; code <= 74; ++code) {
    const DxfTag* tag = face.Find(code);
    // Negative where the edge is invisible, 0 for none.
    const int64_t number = tag ? std::abs(int64_t{face.IntegerOf(*tag)}) : 0;
    if (number > vertices) {
      throw face.ErrorAt(*tag, "a face names vertex " + std::to_string(number) +
                                   ", expected 1 to " + std::to_string(vertices));
    }
    if (number != 0) corners.push_back(static_cast<int>(number) - 1);
  }
  return corners;
}

void AddDxfGrid(const DxfGrid& grid, const std::vector<Vector3d>& vertices, int look,
                DxfBlock* block) {
  const int first = AddDxfVertices(vertices, block);
  const auto index = [&](int row, int column) {
    return row % grid.rows * grid.columns + column % grid.columns;
  };
  const int row_count = grid.closed_along_rows ? grid.rows : grid.rows - 1;
  const int column_count = grid.closed_along_columns ? grid.columns : grid.columns - 1;
  for (int m = 0; m < row_count; ++m) {
    for (int n = 0; n < column_count; ++n) {
      AddDxfFace(look, first, {index(m, n), index(m + 1, n), index(m + 1, n + 1), index(m, n + 1)},
                 block);
    }
  }
}

DxfPath DxfLinePath(const DxfRecord& entity) {
  DxfPath path;
  path.axes = DxfEntityAxes(entity);
  path.thickness = entity.Number(39, 0);
  for (const int code : {10, 11}) {  // the ends of a LINE are in the world's axes
    path.vertices.push_back({path.axes.transpose() * entity.Point(code), 0, 0, 0});
  }
  return path;
}

DxfPath DxfArcPath(const DxfRecord& entity) {
  constexpr double kDegree = std::numbers::pi / 180;
  DxfPath path;
  path.axes = DxfEntityAxes(entity);
  path.thickness = entity.Number(39, 0);
  path.closed = path.capped = entity.kind() == "CIRCLE";
  const double radius = entity.Number(40, 0);
  const double start = path.closed ? 0 : entity.Number(50, 0);
  double sweep = path.closed ? 360 : std::fmod(entity.Number(51, 360) - start, 360);
  if (sweep <= 0) sweep += 360;
  constexpr int kPieces = 4;  // a bulge holds less than a full turn
  for (int i = 0; i < kPieces + (path.closed ? 0 : 1); ++i) {
    const double angle = (start + sweep * i / kPieces) * kDegree;
    path.vertices.push_back(
        {entity.Point(10) + radius * Vector3d(std::cos(angle), std::sin(angle), 0),
         std::tan(sweep * kDegree / kPieces / 4), 0, 0});
  }
  return path;
}

DxfPath DxfLwPolylinePath(const DxfRecord& entity) {
  DxfPath path;
  path.axes = DxfEntityAxes(entity);
  path.thickness = entity.Number(39, 0);
  path.closed = entity.Integer(70, 0) & 1;
  const double elevation = entity.Number(38, 0), width = entity.Number(43, 0);
  for (const DxfTag& tag : entity.tags()) {
    if (tag.code == 10) {
      path.vertices.push_back({{entity.NumberOf(tag), 0, elevation}, 0, width, width});
    }
    if (path.vertices.empty()) continue;
    DxfPathVertex& vertex = path.vertices.back();
    if (tag.code == 20) vertex.point.y() = entity.NumberOf(tag);
    if (tag.code == 40) vertex.start_width = entity.NumberOf(tag);
    if (tag.code == 41) vertex.end_width = entity.NumberOf(tag);
    if (tag.code == 42) vertex.bulge = entity.NumberOf(tag);
  }
  return path;
}

}  // namespace insitu
