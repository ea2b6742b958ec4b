// SPDX-License-Identifier: GPL-3.0-or-later
// How wide a photograph draws one straight edge: the slanted-edge method of ISO 12233 as a fit.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "calibration/photo/photograph.h"

namespace insitu {

// A piece of an edge as it is expected in the photograph: its start, middle and end [px]. The
// middle may lie off the chord, as a lens bends it.
using EdgePiece = std::array<Eigen::Vector2d, 3>;

struct EdgeSpread {
  double sigma = 0;        // [px], of the Gaussian whose integral the edge follows
  double sigma_error = 0;  // [px], its standard deviation
};

// Fits an integrated Gaussian between two even sides, each with a slope of its own, to the
// luminance of the pixels within `kEdgeReach` of the edge; where the edge lies and how it is turned
// is fitted too. nullopt where it is no such edge: a border of the photograph or a clipped pixel
// too near, too little contrast, sides that are not even, an edge beyond 2 px from where it was
// expected, or so parallel to the pixels' rows that it meets them all alike.
constexpr double kEdgeReach = 5;  // [px]
std::optional<EdgeSpread> MeasureEdgeSpread(const Photograph& photo, const EdgePiece& piece);

// Length [px] of a piece in direction `unit` that meets the pixels at all their phases.
// nullopt: it had to be too long to be even.
std::optional<double> SlantedLength(const Eigen::Vector2d& unit);

}  // namespace insitu
