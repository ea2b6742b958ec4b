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
    for (const std::string& vertex : AllVertices(polygon)) names.insert(vertex);
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

// Surveyed, vertices, or joined by pairs.
Names NamedBesidesMarks(const Survey& survey) {
  Names names = Surveyed(survey);
  names.merge(Vertices(survey));
  for (const JoinedPoints& points : JoinedByPairs(survey)) {
    names.insert(points.names.begin(), points.names.end());
  }
  return names;
}

// A point of marks alone needs no other file. But a name near to one that the photo lacks is rather
// a slip.
void RequireKnownMarks(const Survey& survey, const Names& known) {
  for (const ImageObservation& mark : survey.observations) {
    if (known.contains(mark.point)) continue;
    const Names missing = NotMarkedOn(mark.photo, known, survey);
    if (NearNames(mark.point, WithDigitsOf(mark.point, missing)).empty()) continue;
    throw InputError(mark.place.path, mark.place.line,
                     "point '" + mark.point +
                         "' is unknown, expected a point of control_points.csv, polygons.json, "
                         "directions.json, edges.csv or constraints.json, or a name that is not so "
                         "near to that of one" +
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
  RequireKnownMarks(survey, NamedBesidesMarks(survey));
  for (const ImageObservation& mark : survey.observations) found.insert(mark.point);
  RequireFoundEnds(joined, found);
}

void LeaveOutLoneMarks(Survey* survey) {
  const Names known = NamedBesidesMarks(*survey);
  std::map<std::string, int> marks_of_point;
  Names all = known;
  for (const ImageObservation& mark : survey->observations) {
    ++marks_of_point[mark.point];
    all.insert(mark.point);
  }
  const auto is_lone = [&](const ImageObservation& mark) {
    return marks_of_point.at(mark.point) == 1 && !known.contains(mark.point);
  };
  for (const ImageObservation& mark : survey->observations) {
    if (!is_lone(mark)) continue;
    const Names missing = NotMarkedOn(mark.photo, all, *survey);
    survey->lone_marks.push_back({mark, SaidMeant(mark.point, WithDigitsOf(mark.point, missing))});
  }
  std::erase_if(survey->observations, is_lone);
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
