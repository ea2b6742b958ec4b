// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/survey.h"

#include <algorithm>

#include "calibration/files/error.h"

namespace insitu {

std::vector<std::string> AllVertices(const PolygonOutline& polygon) {
  std::vector<std::string> names = polygon.vertices;
  for (const auto& hole : polygon.holes) names.insert(names.end(), hole.begin(), hole.end());
  return names;
}

std::vector<JoinedPoints> JoinedByPairs(const Survey& survey) {
  std::vector<JoinedPoints> joined;
  for (const DirectionPair& pair : survey.sun_pairs) {
    joined.push_back({"sun pair", {pair.from, pair.to}, pair.place});
  }
  for (const DirectionPair& pair : survey.zenith_pairs) {
    joined.push_back({"zenith pair", {pair.from, pair.to}, pair.place});
  }
  for (const EdgeMark& edge : survey.edges) {
    joined.push_back({"edge", {edge.from, edge.to}, edge.place});
  }
  for (const GeometricConstraint& constraint : survey.constraints) {
    joined.push_back({"constraint", constraint.points, constraint.place});
  }
  return joined;
}

std::set<std::string> PointsInUse(const Survey& survey) {
  std::set<std::string> names;
  for (const PolygonOutline& polygon : survey.polygons) {
    for (const std::string& vertex : AllVertices(polygon)) names.insert(vertex);
  }
  for (const ImageObservation& mark : survey.observations) names.insert(mark.point);
  for (const JoinedPoints& points : JoinedByPairs(survey)) {
    names.insert(points.names.begin(), points.names.end());
  }
  return names;
}

FilePlace PlaceOfPoint(const Survey& survey, const std::string& name) {
  for (const ImageObservation& mark : survey.observations) {
    if (mark.point == name) return mark.place;
  }
  for (const ControlPoint& point : survey.control_points) {
    if (point.name == name) return point.place;
  }
  const auto has = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const PolygonOutline& polygon : survey.polygons) {
    if (has(AllVertices(polygon))) return polygon.place;
  }
  for (const JoinedPoints& points : JoinedByPairs(survey)) {
    if (has(points.names)) return points.place;
  }
  throw CheckError(__FILE__, __LINE__, "the point is in the survey");
}

FilePlace FileOfObservations(const Survey& survey) {
  if (!survey.observations.empty()) return {survey.observations[0].place.path, 0};
  return {"survey/observations.csv", 0};
}

}  // namespace insitu
