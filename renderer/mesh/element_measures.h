// SPDX-License-Identifier: GPL-3.0-or-later
// Area and volume of a model's elements, to be compared with what its author knows of them.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "renderer/mesh/model.h"

namespace insitu {

struct ElementMeasures {
  double area = 0;               // [m2], of all faces, both sides of a wall counted
  std::optional<double> volume;  // [m3]; nullopt: open
  int open_edges = 0;            // without a face on their other side, or with one too many
};

// By layer. Faces must be mended (MendSolids); their vertices are one within kJoinTolerance.
std::map<std::string, ElementMeasures> MeasuresByLayer(const ModelMesh& mesh);

// Of all of them; the volume is there if each has one.
ElementMeasures Sum(const std::map<std::string, ElementMeasures>& elements);

}  // namespace insitu
