// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/overlaid_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kSameNormal = 1e-4, kSamePlane = 1e-3;  // [1], [m]
constexpr size_t kMostInAPlane = 4000;                   // pairs are compared

class Overlays {
 public:
  explicit Overlays(ModelMesh* mesh) : mesh_(*mesh), origin_(mesh->vertices[0]) {
    for (const Vector3i& t : mesh_.triangles) {
      area_vectors_.push_back((mesh_.vertices[t[1]] - mesh_.vertices[t[0]])
                                  .cross(mesh_.vertices[t[2]] - mesh_.vertices[t[0]]));
    }
  }

  int Raise(double distance) {
    overlaid_.assign(mesh_.triangles.size(), false);
    for (const double offset : {0.0, 0.5}) ComparePlanes(offset);  // cells have borders
    std::vector<bool> held(mesh_.vertices.size(), false);
    for (size_t t = 0; t < overlaid_.size(); ++t) {
      for (const int v : mesh_.triangles[t]) held[v] = held[v] || !overlaid_[t];
    }
    std::vector<Vector3d> moves(mesh_.vertices.size(), Vector3d::Zero());
    int count = 0;
    for (size_t t = 0; t < overlaid_.size(); ++t) {
      const auto is_held = [&](int v) { return held[v]; };
      if (!overlaid_[t] || std::ranges::any_of(mesh_.triangles[t], is_held)) continue;
      ++count;
      const Vector3d normal = area_vectors_[t].normalized();
      for (const int v : mesh_.triangles[t]) {  // windows that meet at a corner move both ways
        moves[v] += std::max(0.0, distance - moves[v].dot(normal)) * normal;
      }
    }
    for (size_t v = 0; v < moves.size(); ++v) mesh_.vertices[v] += moves[v];
    return count;
  }

 private:
  struct Keyed {
    Eigen::Array<int64_t, 4, 1> plane;
    int triangle;
    bool operator<(const Keyed& other) const {
      return std::lexicographical_compare(plane.begin(), plane.end(), other.plane.begin(),
                                          other.plane.end());
    }
  };

  // The same for both sides of a face.
  Keyed KeyOf(int t, double offset) const {
    Vector3d normal = area_vectors_[t].normalized();
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    if (normal[axis] < 0) normal = -normal;
    const double height = normal.dot(mesh_.vertices[mesh_.triangles[t][0]] - origin_);
    Keyed keyed{{}, t};
    for (int i = 0; i < 3; ++i) {
      keyed.plane[i] = static_cast<int64_t>(std::floor(normal[i] / kSameNormal + offset + 0.25));
    }
    keyed.plane[3] = static_cast<int64_t>(std::floor(height / kSamePlane + offset + 0.25));
    return keyed;
  }

  void ComparePlanes(double offset) {
    std::vector<Keyed> keys;
    keys.reserve(mesh_.triangles.size());
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      keys.push_back(KeyOf(static_cast<int>(t), offset));
    }
    std::ranges::stable_sort(keys, [](const Keyed& a, const Keyed& b) { return a < b; });
    for (size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
      while (end < keys.size() && !(keys[begin] < keys[end])) ++end;
      if (end - begin > kMostInAPlane) continue;
      const auto pairs = static_cast<int64_t>(end - begin) * static_cast<int64_t>(end - begin);
      if (pairs <= pairs_left_) CompareAll(&keys[begin], &keys[0] + end);
    }
  }

  void CompareAll(const Keyed* begin, const Keyed* end) {
    const int first = mesh_.surface_of_triangle[begin->triangle];
    if (std::all_of(begin, end, [&](const Keyed& k) {
          return mesh_.surface_of_triangle[k.triangle] == first;
        })) {
      return;
    }
    pairs_left_ -= (end - begin) * (end - begin);
    for (const Keyed* a = begin; a != end; ++a) {
      for (const Keyed* b = begin; b != end && !overlaid_[a->triangle]; ++b) {
        overlaid_[a->triangle] = LiesOn(a->triangle, b->triangle);
      }
    }
  }

  bool LiesOn(int small, int large) const {
    if (mesh_.surface_of_triangle[small] == mesh_.surface_of_triangle[large]) return false;
    const Vector3d& twice_area = area_vectors_[large];
    if (!(area_vectors_[small].norm() < twice_area.norm())) return false;
    const Vector3i &s = mesh_.triangles[small], &l = mesh_.triangles[large];
    const Vector3d middle =
        (mesh_.vertices[s[0]] + mesh_.vertices[s[1]] + mesh_.vertices[s[2]]) / 3;
    for (int i = 0; i < 3; ++i) {
      const Vector3d &a = mesh_.vertices[l[i]], &b = mesh_.vertices[l[(i + 1) % 3]];
      if ((b - a).cross(middle - a).dot(twice_area) < 0) return false;
    }
    return true;
  }

  ModelMesh& mesh_;
  Vector3d origin_;
  std::vector<Vector3d> area_vectors_;
  std::vector<bool> overlaid_;
  int64_t pairs_left_ = 300000000;  // a second or two
};

}  // namespace

int RaiseOverlaidFaces(ModelMesh* mesh, double distance) {
  if (mesh->triangles.empty() || mesh->surfaces.size() < 2) return 0;
  return Overlays(mesh).Raise(distance);
}

}  // namespace insitu
