// SPDX-License-Identifier: GPL-3.0-or-later
// Points within a face's outline, in its parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

// Of a staggered grid about a `step` (> 0) wide, of at most 256 rows and columns: those within the
// outline (indices into `points`), but for what is closer to its corners than 0.6 steps.
std::vector<Eigen::Vector2d> GridWithin(const std::vector<Eigen::Vector2d>& points,
                                        const std::vector<int>& outline,
                                        const Eigen::Vector2d& step);

}  // namespace insitu
