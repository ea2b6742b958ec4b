// SPDX-License-Identifier: GPL-3.0-or-later
// Start values of a survey that must be whole: where they cannot be found it tells what is missing.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Throws InputError at the first mark off its photograph, of photos of whose marks no larger share
// lies outside: of others all may be counted otherwise, which the diagnosis tells.
void RequireMarksOnPhotographs(const Survey& survey, const std::vector<std::string>& photos,
                               const std::vector<Camera>& cameras, double most_outside = 1);

// Photos that image matching placed take their poses from its model, moved into the world by
// control (align_tie_points.h); without control the model is taken as it is, with a warning. Other
// photos are resected from control, or from points that the placed photos determine. The points are
// those that are marked, or a polygon's vertex, or an end of a direction pair. Throws InputError as
// Adjust does: a mark off its photograph, a photo that cannot be resected, a point that nothing
// determines. `initial_cam_from_world`: a user's estimates, by photo; none is needed.
StartValues FindStartValues(const Survey& survey, const std::vector<std::string>& photos,
                            const std::vector<Camera>& cameras,
                            const std::map<std::string, Rigid3>& initial_cam_from_world = {});

}  // namespace insitu
