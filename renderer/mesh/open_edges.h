// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of a mesh that have no face on one of their sides.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace insitu {

// Two vertices, the smaller first -> how often faces pass from it, less how often to it.
using EdgeCounts = std::unordered_map<uint64_t, int>;

inline int LowOf(uint64_t edge) { return static_cast<int>(edge >> 32); }
inline int HighOf(uint64_t edge) { return static_cast<int>(edge & 0xFFFFFFFF); }

// One that is passed as often either way is none any more.
void AddEdge(int from, int to, int passes, EdgeCounts* edges);

// Cut at the corners of others that lie on them within kJoinTolerance: a side that has three
// neighbours, as some kernels leave it, has no gap. Over 2000 of them are left as they are, as it
// would take long.
EdgeCounts CutAtCorners(const EdgeCounts& edges, const std::vector<Eigen::Vector3d>& vertices);

}  // namespace insitu
