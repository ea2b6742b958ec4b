// SPDX-License-Identifier: GPL-3.0-or-later
// Loops in a surface's parameters: indices into points, closed.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

// Positive: counter-clockwise.
double SignedArea(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& ring);

// Of its points; `ring` is not empty.
Eigen::Vector2d MeanOf(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& ring);

// Whether a place lies within the loop, by the edges that pass on its right.
bool IsWithin(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& ring,
              const Eigen::Vector2d& place);

// Rising x of where a ring crosses a line of constant y: a place on it is within where an odd
// number of them lies beyond.
std::vector<double> CrossingsAt(const std::vector<Eigen::Vector2d>& points,
                                const std::vector<int>& ring, double y);

}  // namespace insitu
