// SPDX-License-Identifier: GPL-3.0-or-later
// Areas, lengths and angles of adjusted polygons with their standard deviations.
#pragma once

#include <utility>
#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct UncertainValue {
  double value = 0, sigma = 0;
};

struct PolygonMeasures {
  UncertainValue area;                // [m^2], without holes
  std::vector<UncertainValue> edges;  // [m], of the outline, then of each hole: vertex to next
  bool is_joint = false;  // from the joint covariance of the vertices; else they count as
                          // independent, which for neighbours is on the safe side as a rule only
};

// Of polygon `index` of the survey. First-order propagation.
PolygonMeasures MeasurePolygon(const Adjustment& adjustment, const PolygonOutline& outline,
                               size_t index);

// The angle between the outward normals of two planes [rad], 0..pi. Their normals count as
// independent: the covariance between planes is not among the adjustment's results.
UncertainValue AngleBetween(const AdjustedPlane& a, const AdjustedPlane& b);

// The angle between a plane's normal, either way, and the zenith [rad]; the zenith counts as exact.
UncertainValue OffLevel(const AdjustedPlane& plane, const Eigen::Vector3d& zenith);

// Pairs of polygons (indices) that share an edge.
std::vector<std::pair<size_t, size_t>> AdjoiningPolygons(const Survey& survey);

}  // namespace insitu
