// SPDX-License-Identifier: GPL-3.0-or-later
// Scale and plumb of image matching's model where no surveyed place gives them: from distances,
// heights, zenith pairs, vertical and level edges, else from how the cameras were held.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/geometry/similarity.h"
#include "reconstruction/survey/survey.h"
#include "reconstruction/survey/tie_points.h"

namespace insitu {

struct UprightModel {
  Similarity3 world_from_model;  // scale and rotation alone
  int lengths = 0;  // distances and heights that gave the scale, as their median; 0: arbitrary
  int plumb = 0;    // statements that gave the zenith; 0: the cameras' own upright
  bool is_contradictory = false;  // lengths differ in scale by over a tenth
};

// Points are located in the model by their marks on two placed photos or more; what names others
// gives nothing. Only a start: the adjustment weighs it all. `cameras` by photo, of all placed
// ones.
UprightModel FindUpright(const Survey& survey, const std::map<std::string, Camera>& cameras,
                         const TiePoints& tie_points);

}  // namespace insitu
