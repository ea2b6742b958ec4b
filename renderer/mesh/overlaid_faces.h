// SPDX-License-Identifier: GPL-3.0-or-later
// Faces drawn onto others, as many programs draw windows onto walls.
#pragma once

#include "renderer/mesh/model.h"

namespace insitu {

// Moves flat patches that lie in a larger face of other names out of it, along their own normal:
// else it is open which of the two is seen. A patch is moved only if no other face shares its
// vertices but such patches, so that nothing is torn. Of planes with over 4000 faces, or beyond 300
// million comparisons, nothing is moved. Returns the number of triangles moved.
int RaiseOverlaidFaces(ModelMesh* mesh, double distance = 0.002);

}  // namespace insitu
