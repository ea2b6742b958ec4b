// SPDX-License-Identifier: GPL-3.0-or-later
// A survey with its start values as a Network.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/photo_lens.h"
#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/network/network.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct SurveyNetwork {
  Network network;
  std::map<std::string, int> index_of_photo, index_of_point, index_of_plane;  // plane by polygon
  std::optional<int> sun, zenith;  // indices of directions; without sun pairs there is no sun
  std::vector<std::string> usual_lenses;  // cameras whose uncertainty is the usual, not their own
};

// `lenses` go with the start values' cameras; without any all share one exact camera.
// Planes are those of polygons with four vertices or more, or that a constraint names. Without
// zenith pairs the z axis is the zenith, fixed.
// A lens without covariance counts as exact where three places are surveyed, whose marks show what
// is wrong with it; photographs alone do not, so it is considered as uncertain as such files are.
// Throws InputError at a direction pair whose points coincide or that contradicts the others.
SurveyNetwork MakeSurveyNetwork(const Survey& survey, const StartValues& start,
                                const std::vector<PhotoLens>& lenses,
                                const AdjustmentOptions& options);

}  // namespace insitu
