// SPDX-License-Identifier: GPL-3.0-or-later
// The responses of a site's photographs that have their raw beside them.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// A camera's own picture and its raw of the same name.
struct PhotographPair {
  std::filesystem::path picture, raw;
};

// Of the site's photographs, those with a raw beside them. Throws InputError as ListPhotographs.
std::vector<PhotographPair> PairsOf(const SitePaths& site);

// As response.json (response.h), an entry a pair, and what is to be told of it.
struct PairedResponses {
  Json::Value file;
  std::string report;  // a line a pair
};

// Throws InputError naming the raw: it does not lie on its picture to half a pixel, or they have
// too little in common.
PairedResponses MeasurePairedResponses(const std::vector<PhotographPair>& pairs);

}  // namespace insitu
