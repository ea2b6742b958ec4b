// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON files of the survey folder: polygons, directions, constraints. All throw InputError at
// the line concerned. Names of points are resolved later, when all files are read.
#pragma once

#include <filesystem>

#include "reconstruction/survey/survey.h"

namespace insitu {

// {"polygons": [{"name", "vertices": [...], "holes": [[...], ...], "photo", "material", "mask"}]};
// holes, photo and mask may be null or missing.
std::vector<PolygonOutline> ReadPolygons(const std::filesystem::path& path,
                                         const std::vector<std::string>& photos);

// {"sun": [{"shadow", "object"}, ...], "zenith": [{"bottom", "top"}, ...]}; both may be missing.
struct DirectionPairs {
  std::vector<DirectionPair> sun, zenith;
};
DirectionPairs ReadDirections(const std::filesystem::path& path);

// {"constraints": [{"kind", "points" or "polygons", "value_m", sigma}, ...]}, where
//   distance, height             two points, value_m and sigma_m (a distance is > 0);
//   vertical, horizontal         two points (an edge) or one polygon,
//   parallel, perpendicular      four points (edge by edge) or two polygons,
// the latter with sigma_deg or sigma_mm_per_m. Other keys, but "comment", are refused: they would
// be slips that nobody notices. Polygons must be among `polygons`.
std::vector<GeometricConstraint> ReadConstraints(const std::filesystem::path& path,
                                                 const std::vector<PolygonOutline>& polygons);

}  // namespace insitu
