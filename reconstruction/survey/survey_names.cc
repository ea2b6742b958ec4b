// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/survey_names.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
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

// Which of some names a photo lacks, since a point has one mark a photo: by index, for a million
// marks.
class NamesByDigits {
 public:
  NamesByDigits(const Names& names, const Survey& survey) {
    for (const std::string& name : names) of_digits_[DigitsWithin(name)].insert(name);
    for (const ImageObservation& mark : survey.observations) marked_[mark.photo].insert(mark.point);
  }

  // Those of the digits of the mark's point, without what its photo shows already.
  Names MissingLike(const ImageObservation& mark) const {
    const auto group = of_digits_.find(DigitsWithin(mark.point));
    if (group == of_digits_.end()) return {};
    const auto& shown = marked_.at(mark.photo);
    Names missing;
    for (const std::string& name : group->second) {
      if (!shown.contains(name)) missing.insert(missing.end(), name);
    }
    return missing;
  }

 private:
  std::unordered_map<std::string, Names> of_digits_;
  std::unordered_map<std::string, std::unordered_set<std::string>> marked_;
};

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
  const NamesByDigits by_digits(known, survey);
  for (const ImageObservation& mark : survey.observations) {
    if (known.contains(mark.point)) continue;
    const Names missing = by_digits.MissingLike(mark);
    if (NearNames(mark.point, missing).empty()) continue;
    throw InputError(mark.place.path, mark.place.line,
                     "point '" + mark.point +
                         "' is unknown, expected a point of control_points.csv, polygons.json, "
                         "directions.json, edges.csv or constraints.json, or a name that is not so "
                         "near to that of one" +
                         DidYouMean(mark.point, missing));
  }
}

// A control point that nothing shows, beside a point without coordinates whose name has the same
// letters: "1" and "001", as spreadsheets drop zeros.
void RequireOneSpelling(const Survey& survey) {
  const Names used = PointsInUse(survey), surveyed = Surveyed(survey);
  std::map<std::string, std::string> unsurveyed_of_essence;
  for (const std::string& name : used) {
    if (!surveyed.contains(name)) unsurveyed_of_essence.emplace(EssenceOf(name), name);
  }
  std::vector<std::pair<const ControlPoint*, std::string>> found;
  for (const ControlPoint& point : survey.control_points) {
    if (used.contains(point.name)) continue;
    const auto other = unsurveyed_of_essence.find(EssenceOf(point.name));
    if (other != unsurveyed_of_essence.end()) found.emplace_back(&point, other->second);
  }
  if (found.empty()) return;
  const auto& [point, other] = found[0];
  const size_t more = found.size() - 1;
  throw InputError(
      point->place.path, point->place.line,
      "control point '" + point->name + "' is marked nowhere, but '" + other +
          "' is and has no coordinates: the names differ only in leading zeros, case, blanks or "
          "signs" +
          (more == 0 ? ""
                     : ", and so do " + std::to_string(more) + (more == 1 ? " other" : " others")) +
          "; expected one name for one point");
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

std::string SitePhotoName(const std::string& photo, const std::vector<std::string>& photos) {
  if (std::find(photos.begin(), photos.end(), photo) != photos.end()) return photo;
  const std::string composed = Composed(photo);
  const auto same = std::find_if(photos.begin(), photos.end(), [&](const std::string& each) {
    return Composed(each) == composed;
  });
  return same == photos.end() ? photo : *same;
}

std::optional<Sentence> FaultOfPhoto(const std::string& photo,
                                     const std::vector<std::string>& photos) {
  if (std::find(photos.begin(), photos.end(), photo) != photos.end()) return std::nullopt;
  Sentence hint = SaidMeant(photo, Names(photos.begin(), photos.end()));
  for (const std::string& known : photos) {
    if (!photo.starts_with(known + ".")) continue;
    hint = Sentence("photoEnding", "; write '{photo}', without the ending", {{"photo", known}});
  }
  return Sentence("photoNotThere", "photo '{photo}' is not in the folder photos{hint}",
                  {{"photo", photo}, {"hint", hint.ToJson()}});
}

void RequireKnownPoints(const Survey& survey) {
  const std::vector<JoinedPoints> joined = JoinedByPairs(survey);
  Names found = Surveyed(survey);
  found.merge(Vertices(survey));
  RequireOneSpelling(survey);
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
  const NamesByDigits by_digits(all, *survey);
  for (const ImageObservation& mark : survey->observations) {
    if (!is_lone(mark)) continue;
    survey->lone_marks.push_back({mark, SaidMeant(mark.point, by_digits.MissingLike(mark))});
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
