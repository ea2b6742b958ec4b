// SPDX-License-Identifier: GPL-3.0-or-later
// Point spread and grain of a photograph, from its surveyed edges and its even places.
#pragma once

#include <optional>
#include <vector>

#include "calibration/photo/photograph.h"
#include "radiometry/light/image_quality.h"
#include "radiometry/measure/edge_spread.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

// Pieces of the polygons' edges where the photograph of camera `index` shows them, each place once.
std::vector<EdgePiece> EdgePiecesIn(const SceneGeometry& scene, size_t index);

// The median of the pieces' spreads; with enough of them over the field, its growth towards the
// corners where that is significant. nullopt: fewer than kFewestEdges pieces can be measured.
constexpr int kFewestEdges = 5;
std::optional<PointSpread> MeasurePointSpread(const Photograph& photo,
                                              const std::vector<EdgePiece>& pieces);

// From the evenest blocks of 8 x 8 pixels at each of several radiances: texture only adds variance.
// nullopt: fewer than kFewestPatches blocks. The rounding of 8-bit codes is taken off, for a
// montage is rounded too.
constexpr int kFewestPatches = 100;
std::optional<Grain> MeasureGrain(const Photograph& photo);

}  // namespace insitu
