// SPDX-License-Identifier: GPL-3.0-or-later
// Which vertices of a mesh are one.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace insitu {

constexpr double kJoinTolerance = 1e-5;  // [m], within which faces meet

inline uint64_t Mixed(uint64_t hash, uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15u + (hash << 6) + (hash >> 2);
  hash *= 0xff51afd7ed558ccdu;
  return hash ^ hash >> 32;
}

// Indices by the hash of their key; the caller compares keys. Open addressing takes half the memory
// of std::unordered_map and a fraction of its time, which 5 million triangles need.
class IndexTable {
 public:
  explicit IndexTable(size_t count) : slots_(std::bit_ceil(2 * count + 16), kFree) {}

  template <typename Equal>
  std::optional<int> Find(uint64_t hash, const Equal& equal) const {
    for (size_t slot = hash & Mask(); slots_[slot] != kFree; slot = (slot + 1) & Mask()) {
      if (equal(slots_[slot])) return slots_[slot];
    }
    return std::nullopt;
  }
  void Add(uint64_t hash, int index) {
    size_t slot = hash & Mask();
    while (slots_[slot] != kFree) slot = (slot + 1) & Mask();
    slots_[slot] = index;
  }

 private:
  static constexpr int kFree = -1;
  size_t Mask() const { return slots_.size() - 1; }
  std::vector<int> slots_;
};

// For each vertex the first of those with equal coordinates.
std::vector<int> FirstOfEqual(const std::vector<Eigen::Vector3d>& vertices);

// For each vertex the first of those nearer than `tolerance`, > 0.
std::vector<int> FirstOfNear(const std::vector<Eigen::Vector3d>& vertices, double tolerance);

}  // namespace insitu
