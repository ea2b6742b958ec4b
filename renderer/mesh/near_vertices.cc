// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/near_vertices.h"

#include <cmath>

namespace insitu {

using Eigen::Vector3d;

std::vector<int> FirstOfEqual(const std::vector<Vector3d>& vertices) {
  IndexTable table(vertices.size());
  std::vector<int> first(vertices.size());
  for (size_t i = 0; i < vertices.size(); ++i) {
    uint64_t hash = 0;
    for (const double x : vertices[i]) hash = Mixed(hash, std::bit_cast<uint64_t>(x + 0.0));
    const auto found = table.Find(hash, [&](int j) { return vertices[j] == vertices[i]; });
    first[i] = found.value_or(static_cast<int>(i));
    if (!found) table.Add(hash, static_cast<int>(i));
  }
  return first;
}

std::vector<int> FirstOfNear(const std::vector<Vector3d>& vertices, double tolerance) {
  IndexTable table(vertices.size());
  std::vector<int> first(vertices.size());
  const auto hash_at = [cell = 4 * tolerance](const Vector3d& place) {
    uint64_t hash = 0;
    for (const double x : place) {
      hash = Mixed(hash, static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / cell))));
    }
    return hash;
  };
  for (size_t i = 0; i < vertices.size(); ++i) {
    const auto is_near = [&](int j) { return (vertices[j] - vertices[i]).norm() <= tolerance; };
    std::optional<int> found;
    uint64_t before = 0;
    for (int side = 0; side < 8 && !found; ++side) {  // the cells that the tolerance reaches into
      const Vector3d reach(side & 1 ? 1 : -1, side & 2 ? 1 : -1, side & 4 ? 1 : -1);
      const uint64_t hash = hash_at(vertices[i] + tolerance * reach);
      if (side == 0 || hash != before) found = table.Find(hash, is_near);
      before = hash;
    }
    first[i] = found.value_or(static_cast<int>(i));
    if (!found) table.Add(hash_at(vertices[i]), static_cast<int>(i));
  }
  return first;
}

}  // namespace insitu
