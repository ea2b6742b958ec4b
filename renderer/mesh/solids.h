// SPDX-License-Identifier: GPL-3.0-or-later
// What is sound about a model's faces, what is not, and what can be mended safely.
#pragma once

#include "renderer/mesh/model.h"
#include "renderer/mesh/near_vertices.h"

namespace insitu {

struct SolidsReport {
  int duplicate_faces = 0;   // dropped: the same corners and names as another triangle
  int degenerate_faces = 0;  // dropped: no area once equal vertices are one
  int coincident_faces = 0;  // the same corners as a triangle of other names: which is seen is open
  int bodies = 0;            // parts that hang together by edges
  int closed_bodies = 0;     // every edge has a face on either side
  int open_edges = 0;        // with one face alone
  int crowded_edges = 0;     // with more than two faces
  int flipped_faces = 0;     // of closed bodies, turned so that all look outwards
  int unmended_faces = 0;    // of open bodies: look another way than most of their neighbours
  int one_sided_bodies = 0;  // no consistent orientation exists (as of a Moebius strip)
};

// Vertices of equal coordinates become one; whether faces meet is judged with `tolerance` [m].
// Closed bodies come out with their faces counter-clockwise seen from outside; those that are
// hollows of others of their layer, drawn so, from within.
SolidsReport MendSolids(ModelMesh* mesh, double tolerance = kJoinTolerance);

}  // namespace insitu
