// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/solids.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "renderer/mesh/face_triangles.h"
#include "renderer/mesh/hollows.h"
#include "renderer/mesh/near_vertices.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

// Keeps the triangles for which `keep` is set, with what belongs to them.
void KeepTriangles(const std::vector<bool>& keep, ModelMesh* mesh) {
  size_t kept = 0;
  for (size_t t = 0; t < keep.size(); ++t) {
    if (!keep[t]) continue;
    mesh->triangles[kept] = mesh->triangles[t];
    mesh->surface_of_triangle[kept] = mesh->surface_of_triangle[t];
    for (size_t c = 0; c < 3; ++c) {
      if (!mesh->corner_normals.empty()) {
        mesh->corner_normals[3 * kept + c] = mesh->corner_normals[3 * t + c];
      }
      if (!mesh->corner_uvs.empty()) mesh->corner_uvs[3 * kept + c] = mesh->corner_uvs[3 * t + c];
    }
    ++kept;
  }
  mesh->triangles.resize(kept);
  mesh->surface_of_triangle.resize(kept);
  if (!mesh->corner_normals.empty()) mesh->corner_normals.resize(3 * kept);
  if (!mesh->corner_uvs.empty()) mesh->corner_uvs.resize(3 * kept);
}

Vector3i Sorted(Vector3i corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

void DropFaultyFaces(ModelMesh* mesh, SolidsReport* report) {
  IndexTable table(mesh->triangles.size());
  std::vector<bool> keep(mesh->triangles.size(), true);
  for (size_t t = 0; t < keep.size(); ++t) {
    const Vector3i corners = Sorted(mesh->triangles[t]);
    if (IsDegenerate(mesh->vertices[corners[0]], mesh->vertices[corners[1]],
                     mesh->vertices[corners[2]])) {
      keep[t] = false;
      ++report->degenerate_faces;
      continue;
    }
    uint64_t hash = 0;
    for (const int corner : corners) hash = Mixed(hash, static_cast<uint64_t>(corner));
    bool coincides = false;
    const auto same = table.Find(hash, [&](int other) {
      if (Sorted(mesh->triangles[other]) != corners) return false;
      coincides = true;
      return mesh->surface_of_triangle[other] == mesh->surface_of_triangle[t];
    });
    keep[t] = !same;
    if (same) {
      ++report->duplicate_faces;
    } else {
      report->coincident_faces += coincides;
      table.Add(hash, static_cast<int>(t));
    }
  }
  KeepTriangles(keep, mesh);
}

// Which triangles hang together, and which way round each lies with respect to its body's first.
class Bodies {
 public:
  explicit Bodies(size_t triangles) : parent_(triangles), turned_(triangles, false) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  struct Root {
    int body;
    bool turned;
  };
  Root Find(int triangle) {
    bool turned = false;
    int root = triangle;
    while (parent_[root] != root) {
      turned ^= turned_[root];
      root = parent_[root];
    }
    bool rest = turned;  // the path becomes direct, for the next call
    while (parent_[triangle] != root) {
      const int up = parent_[triangle];
      const bool own = turned_[triangle];
      parent_[triangle] = root;
      turned_[triangle] = rest;
      rest ^= own;
      triangle = up;
    }
    return {root, turned};
  }
  // False: the two are joined already, the other way round.
  bool Join(int a, int b, bool turned) {
    const Root root_a = Find(a), root_b = Find(b);
    if (root_a.body == root_b.body) return (root_a.turned ^ root_b.turned) == turned;
    const auto [low, high] = std::minmax(root_a.body, root_b.body);
    parent_[high] = low;
    turned_[high] = root_a.turned ^ root_b.turned ^ turned;
    return true;
  }

 private:
  std::vector<int> parent_;
  std::vector<bool> turned_;  // against its parent
};

struct HalfEdge {
  int low, high;  // vertices
  int triangle;
  bool ascending;  // runs from low to high
};

std::vector<HalfEdge> SortedHalfEdges(const ModelMesh& mesh, double tolerance) {
  const std::vector<int> first = FirstOfNear(mesh.vertices, tolerance);
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const int a = first[mesh.triangles[t][c]], b = first[mesh.triangles[t][(c + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  }
  std::ranges::sort(edges, [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

struct BodyState {
  int faces = 0, turned = 0;
  bool open = false, one_sided = false;
  double volume = 0;  // of the faces turned alike
  double area = 0;

  // Two sheets back to back hold nothing: they have no outside.
  bool IsSolid() const {
    return !open && !one_sided && std::abs(volume) > 1e-9 * area * std::sqrt(area);
  }
};

class BodyCheck {
 public:
  BodyCheck(ModelMesh* mesh, SolidsReport* report)
      : mesh_(*mesh),
        report_(*report),
        bodies_(mesh->triangles.size()),
        state_(mesh->triangles.size()) {}

  void Run(double tolerance) {
    const std::vector<HalfEdge> edges = SortedHalfEdges(mesh_, tolerance);
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].low == edges[begin].low &&
             edges[end].high == edges[begin].high) {
        ++end;
      }
      Meet(&edges[begin], end - begin);
    }
    OpenAtCrowdedEdges();
    Gather();
    FindHollows();
    Mend();
  }

 private:
  // The faces at one edge.
  void Meet(const HalfEdge* edges, size_t count) {
    if (count == 1) {
      ++report_.open_edges;
      open_.push_back(edges[0].triangle);
    } else if (count > 2) {
      ++report_.crowded_edges;
      MeetInCrowd(edges, count);
    } else if (!bodies_.Join(edges[0].triangle, edges[1].triangle,
                             edges[0].ascending == edges[1].ascending)) {
      one_sided_.push_back(edges[0].triangle);
    }
  }

  // Where bodies touch, the two faces of one name belong together.
  void MeetInCrowd(const HalfEdge* edges, size_t count) {
    constexpr size_t kMostPaired = 64;  // a fan of thousands would take its square
    std::vector<int> faces;
    for (size_t i = 0; i < count; ++i) {
      faces.push_back(edges[i].triangle);
      size_t partner = count, alike = 0;
      for (size_t j = 0; j < count && count <= kMostPaired; ++j) {
        if (j == i || SurfaceOf(edges[j]) != SurfaceOf(edges[i])) continue;
        partner = j;
        ++alike;
      }
      if (alike != 1 || partner < i) continue;
      const bool turned = edges[i].ascending == edges[partner].ascending;
      if (!bodies_.Join(edges[i].triangle, edges[partner].triangle, turned)) {
        one_sided_.push_back(edges[i].triangle);
      }
    }
    crowds_.push_back(std::move(faces));
  }
  int SurfaceOf(const HalfEdge& edge) const { return mesh_.surface_of_triangle[edge.triangle]; }

  // A body with an odd number of faces at such an edge is open there.
  void OpenAtCrowdedEdges() {
    for (const std::vector<int>& faces : crowds_) {
      std::map<int, int> count_of_body;
      for (const int face : faces) ++count_of_body[bodies_.Find(face).body];
      for (const auto& [body, count] : count_of_body) {
        if (count % 2 == 1) open_.push_back(body);
      }
    }
  }

  void Gather() {
    const Vector3d origin = mesh_.vertices.empty() ? Vector3d::Zero() : mesh_.vertices[0];
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [body, turned] = bodies_.Find(static_cast<int>(t));
      BodyState& state = state_[body];
      const Vector3i& corners = mesh_.triangles[t];
      const Vector3d a = mesh_.vertices[corners[0]] - origin;
      const double volume =
          a.dot((mesh_.vertices[corners[1]] - origin).cross(mesh_.vertices[corners[2]] - origin)) /
          6;
      ++state.faces;
      state.turned += turned;
      state.volume += turned ? -volume : volume;
      state.area += (mesh_.vertices[corners[1]] - mesh_.vertices[corners[0]])
                        .cross(mesh_.vertices[corners[2]] - mesh_.vertices[corners[0]])
                        .norm() /
                    2;
    }
    for (const int t : open_) state_[bodies_.Find(t).body].open = true;
    for (const int t : one_sided_) state_[bodies_.Find(t).body].one_sided = true;
    for (const BodyState& state : state_) {
      if (state.faces == 0) continue;
      ++report_.bodies;
      report_.one_sided_bodies += state.one_sided;
      report_.closed_bodies += state.IsSolid();
      if (state.open && !state.one_sided) {
        report_.unmended_faces += std::min(state.turned, state.faces - state.turned);
      }
    }
  }

  // Bodies that are drawn all one way round mean it.
  void FindHollows() {
    const auto is_drawn_alike = [](const BodyState& s) { return s.IsSolid() && s.turned == 0; };
    if (std::ranges::none_of(state_, [&](const BodyState& s) {
          return s.faces > 0 && s.volume < 0 && is_drawn_alike(s);
        })) {
      return;
    }
    std::map<int, DrawnBody> drawn;
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const int body = bodies_.Find(static_cast<int>(t)).body;
      if (!is_drawn_alike(state_[body])) continue;
      drawn[body].triangles.push_back(static_cast<int>(t));
    }
    std::vector<DrawnBody> bodies;
    for (auto& [body, one] : drawn) {
      bodies.push_back({body, state_[body].volume < 0, std::move(one.triangles)});
    }
    hollows_ = HollowsAmong(mesh_, bodies);
  }

  void Mend() {
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [body, turned] = bodies_.Find(static_cast<int>(t));
      const BodyState& state = state_[body];
      if (!state.IsSolid()) continue;
      if (turned != (state.volume < 0) && !hollows_.contains(body)) Flip(t);
    }
  }

  void Flip(size_t t) {
    ++report_.flipped_faces;
    std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
    if (!mesh_.corner_uvs.empty()) {
      std::swap(mesh_.corner_uvs[3 * t + 1], mesh_.corner_uvs[3 * t + 2]);
    }
    if (mesh_.corner_normals.empty()) return;
    std::swap(mesh_.corner_normals[3 * t + 1], mesh_.corner_normals[3 * t + 2]);
    for (size_t c = 0; c < 3; ++c) mesh_.corner_normals[3 * t + c] *= -1;
  }

  ModelMesh& mesh_;
  SolidsReport& report_;
  Bodies bodies_;
  std::vector<BodyState> state_;
  std::vector<int> open_, one_sided_;
  std::vector<std::vector<int>> crowds_;  // faces at an edge of more than two
  std::set<int> hollows_;                 // bodies that look inwards, as they should
};

}  // namespace

SolidsReport MendSolids(ModelMesh* mesh, double tolerance) {
  SolidsReport report;
  const std::vector<int> first = FirstOfEqual(mesh->vertices);
  for (Vector3i& triangle : mesh->triangles) {
    for (int& corner : triangle) corner = first[corner];
  }
  DropFaultyFaces(mesh, &report);
  BodyCheck(mesh, &report).Run(tolerance);
  DropUnused(mesh);
  return report;
}

}  // namespace insitu
