// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/irradiance_map.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <unordered_map>

#include "calibration/files/error.h"
#include "renderer/trace/profile.h"

namespace insitu {
// Not anonymous: a tree's members have these types.
namespace irradiance_map {

constexpr double kMostInside = 0.5;  // share of back faces seen from a point that lies in the open
constexpr double kCalmShare = 0.5;   // of the mean distance of what is around
constexpr double kSteep = 0.05;      // relative difference between the ends of an edge
constexpr double kGrid = 1e-4;       // points nearer to each other than that are one [m]
constexpr double kNormalGrid = 1e-5;

struct GatheredPoint {
  Eigen::Vector3d position;
  Spectrum before, change;
  double calm = 0;  // edge that is short against what is around [m]
  bool is_open = true;
};

// A point seen from one side of one plane.
struct PointKey {
  std::array<int, 6> cells;
  bool operator==(const PointKey&) const = default;
};

struct PointKeyHash {
  size_t operator()(const PointKey& key) const {
    uint64_t hash = 0;
    for (int cell : key.cells) {
      hash = (hash ^ static_cast<uint32_t>(cell)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

PointKey KeyOf(const SurfacePoint& point) {
  PointKey key;
  for (int i = 0; i < 3; ++i) {
    key.cells[i] = static_cast<int>(std::lround(point.position[i] / kGrid));
    key.cells[3 + i] = static_cast<int>(std::lround(point.normal[i] / kNormalGrid));
  }
  return key;
}

// The middle of a cell stands for all points in it: what is gathered must not depend on which of
// them is asked for first, or the last bit of a picture would depend on the order of its tiles.
SurfacePoint PointOf(const PointKey& key) {
  SurfacePoint point;
  for (int i = 0; i < 3; ++i) {
    point.position[i] = key.cells[i] * kGrid;
    point.normal[i] = key.cells[3 + i];
  }
  point.normal.normalize();
  return point;
}

// A triangle, whole or halved at the middle of its longest edge, from corner `from` to `to`.
struct Node {
  enum class Kind { kUnknown, kLeaf, kHalved };

  std::array<const GatheredPoint*, 3> corners{};
  std::atomic<Kind> kind = Kind::kUnknown;
  int from = 0, to = 1;
  bool matters = false;
  std::unique_ptr<std::array<Node, 2>> halves;
};

double LargestError(const GatheredPoint& a, const GatheredPoint& b, const GatheredPoint& middle) {
  const Spectrum before = (a.before + b.before) / 2, change = (a.change + b.change) / 2;
  const double unit = std::max(
      1e-300, std::max((middle.before + middle.change).maxCoeff(), (before + change).maxCoeff()));
  return std::max((before - middle.before).abs().maxCoeff(),
                  (change - middle.change).abs().maxCoeff()) /
         unit;
}

}  // namespace irradiance_map

using irradiance_map::GatheredPoint, irradiance_map::kCalmShare, irradiance_map::kMostInside,
    irradiance_map::KeyOf, irradiance_map::LargestError, irradiance_map::Node,
    irradiance_map::kSteep, irradiance_map::PointKey, irradiance_map::PointKeyHash,
    irradiance_map::PointOf;

void IrradianceMapOptions::Check() const {
  INSITU_CHECK(tolerance > 0);
  INSITU_CHECK(smallest > 0);
  INSITU_CHECK(calm >= smallest);
  INSITU_CHECK(reach >= 0);
}

struct IrradianceMap::Tree {
  static constexpr size_t kShards = 64;
  struct Shard {
    std::mutex mutex;
    std::unordered_map<PointKey, std::unique_ptr<const GatheredPoint>, PointKeyHash> points;
    std::unordered_map<PointKey, GatheredParts, PointKeyHash> parts;
  };

  Tree(const Interreflection& l, const TriangleMesh& m, std::vector<Eigen::Vector3d> n,
       const IrradianceMapOptions& o)
      : light(l), mesh(m), normals(std::move(n)), options(o), roots(2 * m.triangles.size()) {}

  const Interreflection& light;
  const TriangleMesh& mesh;
  const std::vector<Eigen::Vector3d> normals;
  const IrradianceMapOptions options;
  std::vector<std::atomic<Node*>> roots;  // of each triangle and side, once asked for
  std::array<Shard, kShards> shards;
  std::array<std::mutex, kShards> growing;  // of nodes
  std::mutex rooting;
  std::vector<std::unique_ptr<Node>> owned;

  GatheredPoint Gather(const SurfacePoint& point) const {
    const PhaseScope phase(Phase::kEmbree);
    const GatheredLight light_there = light.At(point);
    GatheredPoint gathered;
    gathered.position = point.position;
    gathered.before = light_there.sky_before + light_there.surroundings_before;
    gathered.change = light_there.change;
    gathered.calm = std::max(options.calm, kCalmShare / std::max(light_there.nearness, 1e-9));
    gathered.is_open = light_there.inside < kMostInside;
    return gathered;
  }

  const GatheredPoint* PointAt(const SurfacePoint& point) {
    const PointKey key = KeyOf(point);
    Shard& shard = shards[PointKeyHash()(key) % kShards];
    {
      const std::lock_guard lock(shard.mutex);
      const auto found = shard.points.find(key);
      if (found != shard.points.end()) return found->second.get();
    }
    // Gathered twice by chance, it is the same both times.
    auto gathered = std::make_unique<const GatheredPoint>(Gather(PointOf(key)));
    const std::lock_guard lock(shard.mutex);
    return shard.points.try_emplace(key, std::move(gathered)).first->second.get();
  }

  // By value: another thread may add to the table.
  GatheredParts PartsOf(const SurfacePoint& point) {
    const PointKey key = KeyOf(point);
    Shard& shard = shards[PointKeyHash()(key) % kShards];
    {
      const std::lock_guard lock(shard.mutex);
      const auto found = shard.parts.find(key);
      if (found != shard.parts.end()) return found->second;
    }
    const GatheredParts parts = light.PartsAt(PointOf(key));
    const std::lock_guard lock(shard.mutex);
    return shard.parts.try_emplace(key, parts).first->second;
  }

  // `flat` on the triangle of the place.
  SurfacePoint PointOn(const FacePlace& place, const Eigen::Vector3d& flat) const {
    SurfacePoint point = PointOnFace(mesh, normals, place.triangle, flat);
    if (place.is_back) point.normal = -point.normal;
    return point;
  }

  // A point of the face, put back onto its triangle.
  Eigen::Vector3d FlatOf(const FacePlace& place, const Eigen::Vector3d& position) const {
    const MeshSphere* sphere = mesh.SphereOf(place.triangle);
    if (!sphere) return position;
    const Eigen::Vector3d corner =
        mesh.vertices[mesh.triangles[place.triangle][0]].cast<double>() - sphere->center;
    const Eigen::Vector3d out = position - sphere->center;
    const Eigen::Vector3d& normal = normals[place.triangle];
    return sphere->center + corner.dot(normal) / out.dot(normal) * out;
  }

  SurfacePoint Middle(const FacePlace& place, const GatheredPoint& a,
                      const GatheredPoint& b) const {
    return PointOn(place, (FlatOf(place, a.position) + FlatOf(place, b.position)) / 2);
  }

  Node& RootOf(const FacePlace& place) {
    std::atomic<Node*>& root = roots[2 * place.triangle + place.is_back];
    if (Node* known = root.load(std::memory_order_acquire)) return *known;
    auto node = std::make_unique<Node>();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d corner =
          mesh.vertices[mesh.triangles[place.triangle][i]].cast<double>();
      node->corners[i] = PointAt(PointOn(place, corner));
    }
    const std::lock_guard lock(rooting);
    if (Node* known = root.load(std::memory_order_acquire)) return *known;
    root.store(node.get(), std::memory_order_release);
    owned.push_back(std::move(node));
    return *owned.back();
  }

  bool Matters(const GatheredPoint& point) const {
    return (point.change.abs() > options.reach * point.before).any();
  }

  // Decides whether it is a leaf; if not, halves it.
  void Grow(Node& node, const FacePlace& place) {
    double longest = -1;
    int from = 0;
    for (int i = 0; i < 3; ++i) {
      const double edge = (node.corners[(i + 1) % 3]->position - node.corners[i]->position).norm();
      if (edge <= longest) continue;
      longest = edge;
      from = i;
    }
    const int to = (from + 1) % 3;
    const GatheredPoint &a = *node.corners[from], &b = *node.corners[to];
    const GatheredPoint* middle = nullptr;
    bool is_leaf = longest < options.smallest || (IsApart(node, longest) && IsEven(node, longest));
    if (!is_leaf) {
      middle = PointAt(Middle(place, a, b));
      is_leaf = IsApart(node, longest) && IsCalm(node, *middle, longest, a, b) &&
                IsStraight(node, from, place);
    }
    const std::lock_guard lock(
        growing[reinterpret_cast<uintptr_t>(&node) / sizeof(Node) % kShards]);
    if (node.kind.load(std::memory_order_acquire) != Node::Kind::kUnknown) return;
    node.from = from;
    node.to = to;
    for (const GatheredPoint* corner : node.corners) node.matters |= Matters(*corner);
    if (!is_leaf) {
      node.halves = std::make_unique<std::array<Node, 2>>();
      (*node.halves)[0].corners = (*node.halves)[1].corners = node.corners;
      (*node.halves)[0].corners[to] = middle;
      (*node.halves)[1].corners[from] = middle;
    }
    node.kind.store(is_leaf ? Node::Kind::kLeaf : Node::Kind::kHalved, std::memory_order_release);
  }

  // From the building, as far as it is long.
  bool IsApart(const Node& node, double edge) const {
    if (options.building.isEmpty() || edge <= options.calm) return true;
    Eigen::AlignedBox3d box;
    for (const GatheredPoint* corner : node.corners) box.extend(corner->position);
    return options.building.squaredExteriorDistance(box) >= edge * edge;
  }

  // Corners so alike that what lies between is, too.
  bool IsEven(const Node& node, double edge) const {
    for (const GatheredPoint* corner : node.corners) {
      if (!corner->is_open || edge > corner->calm) return false;
    }
    const auto& [a, b, c] = node.corners;
    return LargestError(*a, *a, *b) < options.tolerance &&
           LargestError(*b, *b, *c) < options.tolerance &&
           LargestError(*c, *c, *a) < options.tolerance;
  }

  bool IsCalm(const Node& node, const GatheredPoint& middle, double edge, const GatheredPoint& a,
              const GatheredPoint& b) const {
    if (!middle.is_open || edge > middle.calm) return false;
    for (const GatheredPoint* corner : node.corners) {
      if (!corner->is_open || edge > corner->calm) return false;
    }
    return LargestError(a, b, middle) < options.tolerance;
  }

  // Whether the steepest edge but the longest is, too, where it is steep: a corner may lie in the
  // dark of another face.
  bool IsStraight(const Node& node, int longest, const FacePlace& place) {
    int steepest = 0;
    double difference = kSteep;
    for (int i = 0; i < 3; ++i) {
      const GatheredPoint &a = *node.corners[i], &b = *node.corners[(i + 1) % 3];
      const double one = LargestError(a, a, b);
      if (i == longest || one <= difference) continue;
      difference = one;
      steepest = i;
    }
    if (difference <= kSteep) return true;
    const GatheredPoint &a = *node.corners[steepest], &b = *node.corners[(steepest + 1) % 3];
    const GatheredPoint& middle = *PointAt(Middle(place, a, b));
    return middle.is_open && LargestError(a, b, middle) < options.tolerance;
  }

  SmoothLight Interpolate(const Node& node, const Eigen::Vector3d& weights,
                          const FacePlace& place) {
    SmoothLight light_there;
    light_there.matters = node.matters;
    double total = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      position += weights[i] * FlatOf(place, node.corners[i]->position);
      if (!node.corners[i]->is_open) continue;
      total += weights[i];
      light_there.before += weights[i] * node.corners[i]->before;
      light_there.change += weights[i] * node.corners[i]->change;
    }
    if (total > 0) {
      light_there.before /= total;
      light_there.change /= total;
      return light_there;
    }
    // All corners lie within solids; the point asked for is what a ray sees.
    const GatheredPoint& alone = *PointAt(PointOn(place, position));
    return {alone.before, alone.change, Matters(alone)};
  }

  // The same of what its light is made of.
  GatheredParts InterpolateParts(const Node& node, const Eigen::Vector3d& weights,
                                 const FacePlace& place) {
    GatheredParts sum;
    double total = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d corner = FlatOf(place, node.corners[i]->position);
      position += weights[i] * corner;
      if (!node.corners[i]->is_open) continue;
      total += weights[i];
      sum.Add(weights[i], PartsOf(PointOn(place, corner)));
    }
    if (total <= 0) return PartsOf(PointOn(place, position));
    GatheredParts mean;
    mean.Add(1 / total, sum);
    return mean;
  }

  struct Leaf {
    const Node& node;
    Eigen::Vector3d weights;
  };

  // The leaf that holds the place, which is grown where nobody has asked yet.
  Leaf LeafAt(const FacePlace& place) {
    Node* node = &RootOf(place);
    Eigen::Vector3d weights(1 - place.uv.sum(), place.uv.x(), place.uv.y());
    for (;;) {
      Node::Kind kind = node->kind.load(std::memory_order_acquire);
      if (kind == Node::Kind::kUnknown) {
        Grow(*node, place);
        kind = node->kind.load(std::memory_order_acquire);
      }
      if (kind == Node::Kind::kLeaf) return {*node, weights};
      // A point w_f F + w_t T + ..., with M = (F + T) / 2, is (w_f - w_t) F + 2 w_t M + ...
      const bool near_from = weights[node->from] >= weights[node->to];
      const int kept = near_from ? node->from : node->to, left = near_from ? node->to : node->from;
      weights[kept] -= weights[left];
      weights[left] *= 2;
      node = &(*node->halves)[near_from ? 0 : 1];
    }
  }
};

IrradianceMap::IrradianceMap(const Interreflection& light, const TriangleMesh& mesh,
                             std::vector<Eigen::Vector3d> normals,
                             const IrradianceMapOptions& options, std::span<const KeptPoint> kept)
    : tree_(std::make_unique<Tree>(light, mesh, std::move(normals), options)) {
  options.Check();
  for (Tree::Shard& shard : tree_->shards) shard.points.reserve(kept.size() / Tree::kShards);
  for (const KeptPoint& point : kept) {
    const PointKey key{point.cells};
    auto gathered = std::make_unique<const GatheredPoint>(GatheredPoint{
        PointOf(key).position, point.before, point.change, point.calm, point.is_open});
    tree_->shards[PointKeyHash()(key) % Tree::kShards].points.emplace(key, std::move(gathered));
  }
}

IrradianceMap::~IrradianceMap() = default;

SmoothLight IrradianceMap::At(const FacePlace& place) const {
  const Tree::Leaf leaf = tree_->LeafAt(place);
  return tree_->Interpolate(leaf.node, leaf.weights, place);
}

GatheredParts IrradianceMap::PartsAt(const FacePlace& place) const {
  const Tree::Leaf leaf = tree_->LeafAt(place);
  return tree_->InterpolateParts(leaf.node, leaf.weights, place);
}

std::vector<KeptPoint> IrradianceMap::Kept() const {
  std::vector<KeptPoint> kept;
  for (Tree::Shard& shard : tree_->shards) {
    const std::lock_guard lock(shard.mutex);
    for (const auto& [key, point] : shard.points) {
      kept.push_back({key.cells, point->before, point->change, point->calm, point->is_open});
    }
  }
  std::ranges::sort(kept, {}, &KeptPoint::cells);
  return kept;
}

long IrradianceMap::points() const {
  long count = 0;
  for (Tree::Shard& shard : tree_->shards) {
    const std::lock_guard lock(shard.mutex);
    count += static_cast<long>(shard.points.size());
  }
  return count;
}

}  // namespace insitu
