// SPDX-License-Identifier: GPL-3.0-or-later
// The synthetic town as image matching would have it: tie points in a frame of their own.
#pragma once

#include <map>
#include <string>

#include "calibration/lens/camera.h"
#include "reconstruction/geometry/similarity.h"
#include "reconstruction/survey/tie_points.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {

std::map<std::string, Camera> CamerasOf(const SyntheticNetwork& network);

// Of the town at its default origin.
Similarity3 ModelFromWorld();

// The town's photographs in the model's frame, with points between its houses, without error: those
// of `count` that two photographs or more show.
TiePoints ModelOf(const SyntheticNetwork& network, int count);

}  // namespace insitu
