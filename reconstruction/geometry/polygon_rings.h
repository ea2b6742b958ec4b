// SPDX-License-Identifier: GPL-3.0-or-later
// A planar polygon with holes: what is wrong with its rings, and its triangles.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/files/sentence.h"

namespace insitu {

using Ring = std::vector<Eigen::Vector3d>;  // [m]

struct RingFault {
  std::optional<size_t> hole;  // nullopt: the outline
  Sentence what;               // "hole 2 is not inside the outline"
};

// Why an outline with holes encloses nothing that could be seen: a ring crosses itself or has no
// area, a hole is not within the outline, two holes overlap; nullopt if nothing is wrong. Rings may
// turn either way.
std::optional<RingFault> FaultOfRings(const Ring& outline, const std::vector<Ring>& holes,
                                      const Eigen::Vector3d& normal);

// Triangles of what lies within the outline and in no hole, about `normal`: indices into the
// outline's vertices followed by each hole's. nullopt exactly where there is a fault.
std::optional<std::vector<Eigen::Vector3i>> TriangulateRings(const Ring& outline,
                                                             const std::vector<Ring>& holes,
                                                             const Eigen::Vector3d& normal);

}  // namespace insitu
