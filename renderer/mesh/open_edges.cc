// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/open_edges.h"

#include <iterator>
#include <map>
#include <set>

#include "renderer/mesh/near_vertices.h"

namespace insitu {

using Eigen::Vector3d;

void AddEdge(int from, int to, int passes, EdgeCounts* edges) {
  if (from == to) return;
  const bool upwards = from < to;
  const auto low = static_cast<uint64_t>(upwards ? from : to);
  const auto high = static_cast<uint64_t>(upwards ? to : from);
  const auto edge = edges->try_emplace(low << 32 | high, 0).first;
  edge->second += upwards ? passes : -passes;
  if (edge->second == 0) edges->erase(edge);
}

EdgeCounts CutAtCorners(const EdgeCounts& edges, const std::vector<Vector3d>& vertices) {
  constexpr size_t kMost = 2000;
  if (edges.empty() || edges.size() > kMost) return edges;
  std::set<int> corners;
  for (const auto& [edge, passes] : edges) corners.insert({LowOf(edge), HighOf(edge)});
  EdgeCounts pieces;
  for (const auto& [edge, passes] : edges) {
    const Vector3d& from = vertices[LowOf(edge)];
    const Vector3d way = vertices[HighOf(edge)] - from;
    std::map<double, int> stops;
    for (const int corner : corners) {
      const double along = (vertices[corner] - from).dot(way) / way.squaredNorm();
      const double off = (vertices[corner] - from - along * way).norm();
      if (along > 0 && along < 1 && off <= kJoinTolerance) stops[along] = corner;
    }
    stops[0] = LowOf(edge);
    stops[1] = HighOf(edge);
    for (auto stop = stops.begin(), next = std::next(stop); next != stops.end(); ++stop, ++next) {
      AddEdge(stop->second, next->second, passes, &pieces);
    }
  }
  return pieces;
}

}  // namespace insitu
