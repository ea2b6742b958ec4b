// SPDX-License-Identifier: GPL-3.0-or-later
// Why photos, points and what names them take no part in the adjustment yet.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "calibration/files/sentence.h"

namespace insitu {

// `known`: how many of its marked points are determined; `can_resect`: they do not lie on a line.
Sentence ReasonOfPhoto(size_t known, bool can_resect);

// `rays`: from posed photos; `photos`: all on which it is marked.
Sentence ReasonOfPoint(size_t rays, const std::set<std::string>& photos);

// Something needed is not determined: the vertex of a polygon, ...
using ReasonByName = Sentence(const std::string& name);
ReasonByName NoVertex, NoPoint, NoEnd, NoPolygon;

}  // namespace insitu
