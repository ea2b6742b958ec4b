// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>

#include "reconstruction/colmap/colmap_model.h"

namespace insitu {

// Leaves the images with these ids, the cameras that they name, and the points that two of them
// show; keypoints of other points stay, as such of none.
void KeepImages(const std::set<uint32_t>& ids, ColmapModel* model);

}  // namespace insitu
