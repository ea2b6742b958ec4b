// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/survey_names.h"

#include <algorithm>
#include <map>
#include <set>

#include "calibration/files/error.h"
#include "reconstruction/survey/near_names.h"
#include "reconstruction/survey/tie_points.h"

namespace insitu {
namespace {

using Names = std::set<std::string>;

Names Vertices(const Survey& survey) {
  Names names;
  for (const PolygonOutline& polygon : survey.polygons) {
    names.insert(polygon.vertices.begin(), polygon.vertices.end());
  }
  return names;
}

Names Surveyed(const Survey& survey) {
  Names names;
  for (const ControlPoint& point : survey.control_points) names.insert(point.name);
  return names;
}

// Without those that the photo shows already: a point has one mark a photo.
Names NotMarkedOn(const std::string& photo, Names names, const Survey& survey) {
  for (const ImageObservation& mark : survey.observations) {
    if (mark.photo == photo) names.erase(mark.point);
  }
  return names;
}

// A point that two photos show needs no other file: it ties them together. But a name near to one
// that the photo lacks is rather a slip.
void RequireKnownMarks(const Survey& survey, const Names& known) {
  std::map<std::string, int> photos_of_point;
  for (const ImageObservation& mark : survey.observations) ++photos_of_point[mark.point];
  for (const ImageObservation& mark : survey.observations) {
    if (known.contains(mark.point)) continue;
    const Names missing = NotMarkedOn(mark.photo, known, survey);
    if (photos_of_point.at(mark.point) > 1 &&
        NearNames(mark.point, WithDigitsOf(mark.point, missing)).empty()) {
      continue;
    }
    throw InputError(mark.place.path, mark.place.line,
                     "point '" + mark.point +
                         "' is unknown, expected a point of control_points.csv, polygons.json, "
                         "directions.json, edges.csv or constraints.json, or one marked on two "
                         "photos" +
                         DidYouMean(mark.point, missing));
  }
}

void RequireFoundEnds(const std::vector<JoinedPoints>& joined, const Names& found) {
  for (const JoinedPoints& points : joined) {
    for (const std::string& name : points.names) {
      if (found.contains(name)) continue;
      throw InputError(points.place.path, points.place.line,
                       "point '" + name + "' of the " + points.subject +
                           " is unknown, expected a point of control_points.csv, "
                           "observations.csv or polygons.json" +
                           DidYouMean(name, found));
    }
  }
}

}  // namespace

std::optional<std::string> FaultOfPhoto(const std::string& photo,
                                        const std::vector<std::string>& photos) {
  if (std::find(photos.begin(), photos.end(), photo) != photos.end()) return std::nullopt;
  std::string hint = DidYouMean(photo, Names(photos.begin(), photos.end()));
  for (const std::string& known : photos) {
    if (photo.starts_with(known + ".")) hint = "; write '" + known + "', without the ending";
  }
  return "photo '" + photo + "' is not in the folder photos" + hint;
}

void RequireKnownPoints(const Survey& survey) {
  const std::vector<JoinedPoints> joined = JoinedByPairs(survey);
  Names found = Surveyed(survey);
  found.merge(Vertices(survey));
  Names known = found;
  for (const JoinedPoints& points : joined) known.insert(points.names.begin(), points.names.end());
  RequireKnownMarks(survey, known);
  for (const ImageObservation& mark : survey.observations) found.insert(mark.point);
  RequireFoundEnds(joined, found);
}

void RequireNoNamesOfTiePoints(const Survey& survey) {
  Names names = PointsInUse(survey);
  names.merge(Surveyed(survey));
  for (const std::string& name : names) {
    if (!IsTiePointName(name)) continue;
    const FilePlace place = PlaceOfPoint(survey, name);
    throw InputError(place.path, place.line,
                     "point '" + name +
                         "' is named as tie points are, expected another name for a point of the "
                         "survey");
  }
}

}  // namespace insitu
