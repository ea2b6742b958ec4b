// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnose_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "calibration/files/wording.h"
#include "reconstruction/survey/near_names.h"

namespace insitu {
namespace {

constexpr double kWidestSite = 200000;  // [m]; the earth's curvature hides what is farther
constexpr double kGapOverSpread = 20;   // between two groups, of the wider one's spread

using Points = std::vector<const ControlPoint*>;

// Along one axis: the widest gap splits the points into two groups.
struct Gap {
  int axis = 0;
  double width = 0, spread = 0;  // [m], of the gap and of the wider group
  Points low, high;
};

Gap WidestGap(Points points, int axis) {
  const auto coordinate = [&](size_t i) { return points[i]->position[axis]; };
  std::sort(points.begin(), points.end(),
            [&](const auto* a, const auto* b) { return a->position[axis] < b->position[axis]; });
  size_t split = 1;
  for (size_t i = 1; i < points.size(); ++i) {
    if (coordinate(i) - coordinate(i - 1) > coordinate(split) - coordinate(split - 1)) split = i;
  }
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(split);
  return {axis, coordinate(split) - coordinate(split - 1),
          std::max(coordinate(split - 1) - coordinate(0),
                   coordinate(points.size() - 1) - coordinate(split)),
          Points(points.begin(), middle), Points(middle, points.end())};
}

// In the order of the file.
std::vector<std::string> NamesOf(Points points) {
  std::sort(points.begin(), points.end(),
            [](const auto* a, const auto* b) { return a->place.line < b->place.line; });
  std::vector<std::string> names;
  for (const ControlPoint* point : points) names.push_back(point->name);
  return names;
}

// Of national coordinates a slip of the unit shows to the digit.
Sentence WordOnUnit(const Points& odd, const Points& rest, int axis) {
  const double ratio = odd.front()->position[axis] / rest.front()->position[axis];
  if (std::abs(ratio / 1000 - 1) >= 0.01) return Sentence::Verbatim("");
  return Sentence("rowsMillimetres", " (are they in millimetres?)");
}

std::vector<Diagnosis> TwoSystems(const Points& points) {
  for (int axis = 0; axis < 3 && points.size() > 1; ++axis) {
    const Gap gap = WidestGap(points, axis);
    if (gap.width < kWidestSite || gap.width < kGapOverSpread * gap.spread) continue;
    const bool is_low_odd = gap.low.size() <= gap.high.size();
    const Points& odd = is_low_odd ? gap.low : gap.high;
    const Points& rest = is_low_odd ? gap.high : gap.low;
    const auto* first = *std::min_element(odd.begin(), odd.end(), [](const auto* a, const auto* b) {
      return a->place.line < b->place.line;
    });
    const Sentence::Values values = {{"names", SaidNames(NamesOf(odd))},
                                     {"distance", ShortNumber(gap.width / 1000)},
                                     {"count", static_cast<Json::UInt64>(rest.size())},
                                     {"axis", std::string(1, "xyz"[axis])},
                                     {"unit", WordOnUnit(odd, rest, axis).ToJson()}};
    return {{first->place,
             odd.size() == 1
                 ? Sentence("rowsOneFar",
                            "the control points are in two coordinate systems: {names} lies "
                            "{distance} km from the {count} others along {axis}{unit}. Expected: "
                            "all coordinates in one system and one unit",
                            values)
                 : Sentence("rowsSomeFar",
                            "the control points are in two coordinate systems: {names} lie "
                            "{distance} km from the {count} others along {axis}{unit}. Expected: "
                            "all coordinates in one system and one unit",
                            values)}};
  }
  return {};
}

std::vector<Diagnosis> Degrees(const Points& points) {
  if (points.size() < 3) return {};
  Eigen::Array3d low = points[0]->position.array(), high = low;
  for (const ControlPoint* point : points) {
    low = low.min(point->position.array());
    high = high.max(point->position.array());
  }
  const Eigen::Array3d spread = high - low;
  const bool are_angles = std::max(-low[0], high[0]) <= 180 && std::max(-low[1], high[1]) <= 180;
  const bool is_needle =
      spread[0] < 0.1 && spread[1] < 0.1 && spread[2] > 50 * spread.head<2>().maxCoeff();
  if (!are_angles || !is_needle) return {};
  return {{points[0]->place,
           Sentence("rowsDegrees",
                    "x and y of the control points look like longitude and latitude in degrees: "
                    "they span {x} and {y}, z spans {z}. Expected: metres of a map projection or a "
                    "local system",
                    {{"x", ShortNumber(spread[0])},
                     {"y", ShortNumber(spread[1])},
                     {"z", ShortNumber(spread[2])}})}};
}

std::vector<Diagnosis> SameCoordinates(const Survey& survey) {
  const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::map<Eigen::Vector3d, const ControlPoint*, decltype(less)> first_there(less);
  std::vector<Diagnosis> diagnoses;
  for (const ControlPoint& point : survey.control_points) {
    const auto [first, is_new] = first_there.emplace(point.position, &point);
    if (is_new) continue;
    diagnoses.push_back({point.place,
                         Sentence("rowsSamePlace",
                                  "point '{name}' has the same coordinates as '{other}' in line "
                                  "{line}: is one of them a slip of copying? Expected: each point "
                                  "once, under one name",
                                  {{"name", point.name},
                                   {"other", first->second->name},
                                   {"line", first->second->place.line}}),
                         Diagnosis::Kind::kQuestion});
  }
  return diagnoses;
}

// Photos whose common points are all marked at the very same pixels.
std::vector<Diagnosis> SameMarks(const Survey& survey) {
  using Key = std::pair<std::string, std::pair<double, double>>;
  std::map<Key, std::vector<const ImageObservation*>> marks_at;
  std::map<std::string, int> count_on;
  for (const ImageObservation& mark : survey.observations) {
    marks_at[{mark.point, {mark.pixel.x(), mark.pixel.y()}}].push_back(&mark);
    ++count_on[mark.photo];
  }
  std::map<std::pair<std::string, std::string>, std::vector<const ImageObservation*>> common;
  for (const auto& [key, marks] : marks_at) {
    for (size_t i = 1; i < marks.size(); ++i) {
      common[{marks[0]->photo, marks[i]->photo}].push_back(marks[i]);
    }
  }
  std::vector<Diagnosis> diagnoses;
  for (const auto& [photos, marks] : common) {
    const int fewer = std::min(count_on[photos.first], count_on[photos.second]);
    if (marks.size() < 3 || 2 * static_cast<int>(marks.size()) < fewer) continue;
    diagnoses.push_back(
        {marks.front()->place,
         Sentence("rowsSameMarks",
                  "photo '{other}' has the very marks of photo '{one}' on {count} points: they are "
                  "the same photograph, or the rows were copied. Expected: each photograph and "
                  "each measurement once, for they would count twice",
                  {{"one", photos.first},
                   {"other", photos.second},
                   {"count", static_cast<Json::UInt64>(marks.size())}})});
  }
  return diagnoses;
}

// A control point that nothing refers to, while a name near its own is in use but not surveyed.
std::vector<Diagnosis> UnusedControl(const Survey& survey) {
  const std::set<std::string> in_use = PointsInUse(survey);
  std::set<std::string> unsurveyed = in_use;
  for (const ControlPoint& point : survey.control_points) unsurveyed.erase(point.name);
  std::vector<Diagnosis> diagnoses;
  for (const ControlPoint& point : survey.control_points) {
    if (in_use.contains(point.name)) continue;
    const Sentence meant = SaidMeant(point.name, WithDigitsOf(point.name, unsurveyed));
    if (meant.empty()) continue;
    diagnoses.push_back({point.place,
                         Sentence("rowsUnused",
                                  "point '{name}' is marked on no photo and in no polygon{meant} "
                                  "Expected: one name for one point in all files",
                                  {{"name", point.name}, {"meant", meant.ToJson()}}),
                         Diagnosis::Kind::kMisfit, point.name});
  }
  return diagnoses;
}

// Never in silence: a mark that does not count may be one under a wrong name.
std::vector<Diagnosis> LoneMarks(const Survey& survey) {
  std::vector<Diagnosis> diagnoses;
  for (const LoneMark& lone : survey.lone_marks) {
    diagnoses.push_back({lone.mark.place,
                         Sentence("rowsLoneMark",
                                  "point '{name}': one ray only, from photo '{photo}', not "
                                  "determined; left out. Expected: a mark on a second photo, or a "
                                  "polygon that holds it{meant}",
                                  {{"name", lone.mark.point},
                                   {"photo", lone.mark.photo},
                                   {"meant", lone.question.ToJson()}}),
                         Diagnosis::Kind::kQuestion});
  }
  return diagnoses;
}

}  // namespace

std::vector<Diagnosis> DiagnoseRows(const Survey& survey) {
  Points control;
  for (const ControlPoint& point : survey.control_points) control.push_back(&point);
  std::vector<Diagnosis> diagnoses = TwoSystems(control);
  if (diagnoses.empty()) diagnoses = Degrees(control);
  for (const auto& part :
       {SameMarks(survey), UnusedControl(survey), SameCoordinates(survey), LoneMarks(survey)}) {
    diagnoses.insert(diagnoses.end(), part.begin(), part.end());
  }
  return diagnoses;
}

}  // namespace insitu
