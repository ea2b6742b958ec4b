// SPDX-License-Identifier: GPL-3.0-or-later
// Closed bodies that are hollows of others.
#pragma once

#include <set>
#include <vector>

#include "renderer/mesh/model.h"

namespace insitu {

// A closed body as it is drawn, all of its faces one way round.
struct DrawnBody {
  int body = 0;                // its name among others
  bool looks_inwards = false;  // as drawn
  std::vector<int> triangles;  // indices into those of the mesh; at least one
};

// Those that look inwards and lie within one of the same layer that looks outwards. Of more pairs
// than a second suffices for, those looked at first.
std::set<int> HollowsAmong(const ModelMesh& mesh, const std::vector<DrawnBody>& bodies);

}  // namespace insitu
