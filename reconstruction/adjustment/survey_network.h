// SPDX-License-Identifier: GPL-3.0-or-later
// A survey with its start values as a Network.
#pragma once

#include <map>
#include <string>

#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/network/network.h"

namespace insitu {

struct SurveyNetwork {
  Network network;
  std::map<std::string, int> index_of_photo, index_of_point, index_of_plane;  // plane by polygon
  std::optional<int> sun, zenith;  // indices of directions; without sun pairs there is no sun
};

// Planes are those of polygons with four vertices or more, or that a constraint names. Without
// zenith pairs the z axis is the zenith, fixed.
// Throws InputError at a direction pair whose points coincide or that contradicts the others.
SurveyNetwork MakeSurveyNetwork(const Survey& survey, const StartValues& start,
                                const AdjustmentOptions& options);

}  // namespace insitu
