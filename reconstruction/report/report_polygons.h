// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons in the report, with their planes, their angles and the directions to sun and zenith.
// The keys of the JSON are the report's format.
#pragma once

#include <json/value.h>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

Json::Value PolygonsSection(const Adjustment& adjustment, const Survey& survey);
Json::Value AdjoiningSection(const Adjustment& adjustment, const Survey& survey);
Json::Value PlaneEffectSection(const PlaneEffect& effect);
Json::Value DirectionsSection(const Adjustment& adjustment, const Survey& survey);

}  // namespace insitu
