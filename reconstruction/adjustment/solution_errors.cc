// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/solution_errors.h"

#include <set>

#include "calibration/files/wording.h"
#include "reconstruction/adjustment/adjusted_unknowns.h"

namespace insitu {
namespace {

// Where the observations stand, for faults that none of them is to blame for.
FilePlace PlaceOfObservations(const Survey& survey) {
  if (!survey.observations.empty()) return survey.observations[0].place;
  return {survey.tie_points ? "work/tie_points/tie_points.json" : "survey/observations.csv", 0};
}

FilePlace PlaceOf(const Unknown& unknown, const SurveyNetwork& survey_network,
                  const Survey& survey) {
  const Network& network = survey_network.network;
  if (unknown.kind == Unknown::Kind::kPoint && !network.points[unknown.index].is_tie_point) {
    return PlaceOfPoint(survey, network.points[unknown.index].name);
  }
  if (unknown.kind == Unknown::Kind::kDirection) {
    const bool is_sun = survey_network.sun == unknown.index;
    return (is_sun ? survey.sun_pairs : survey.zenith_pairs).at(0).place;
  }
  for (const PolygonOutline& polygon : survey.polygons) {
    if (unknown.kind == Unknown::Kind::kPlane &&
        polygon.name == network.planes[unknown.index].name) {
      return polygon.place;
    }
  }
  for (const ImageObservation& mark : survey.observations) {
    if (unknown.kind == Unknown::Kind::kPhoto && mark.photo == network.photos[unknown.index].name) {
      return mark.place;
    }
  }
  return PlaceOfObservations(survey);
}

const char* Remedy(Unknown::Kind kind) {
  switch (kind) {
    case Unknown::Kind::kCamera:
      return "more photos from other sides, or a lens model of fewer parameters (insitu-calibrate "
             "--lens-model LENSMODEL_OPENCV4)";
    case Unknown::Kind::kPhoto:
      return "more marks of well spread points on it, or its surveyed position";
    case Unknown::Kind::kPoint:
      return "a mark of it on one more photo, its surveyed coordinates, or a polygon whose plane "
             "holds it";
    case Unknown::Kind::kPlane:
      return "three of its vertices determined by marks or survey, not on one line";
    case Unknown::Kind::kDirection:
      break;
  }
  return "more pairs of points in directions.json";
}

}  // namespace

InputError RankDefectError(const RankDefect& defect, const SurveyNetwork& survey_network,
                           const Survey& survey) {
  std::set<std::string> names;
  for (const RankDefect::Column& column : defect.columns) {
    names.insert(ColumnNames(survey_network.network, column.unknown)
                     .at(static_cast<size_t>(column.component)));
  }
  const Unknown& first = defect.columns.front().unknown;
  const FilePlace place = PlaceOf(first, survey_network, survey);
  return InputError(
      place.path, place.line,
      Listing("the observations do not determine unknowns", {names.begin(), names.end()}) +
          "; expected " + Remedy(first.kind));
}

InputError NoSolutionError(const NoSolution& failure, const Network& network,
                           const Survey& survey) {
  const FilePlace place = PlaceOfObservations(survey);
  if (!failure.row || failure.row->kind != ObservationRow::Kind::kMark) {
    return InputError(place.path, "the adjustment fails: " + std::string(failure.what()) +
                                      ", expected marks that fit their points");
  }
  const MarkObservation& mark = network.marks[failure.row->index];
  const std::string &photo = network.photos[mark.photo].name,
                    &point = network.points[mark.point].name;
  const std::string fault = "point '" + point + "' lies behind photo '" + photo +
                            "' that shows it, expected another point or another place of the "
                            "photo: is the mark under the right name?";
  for (const ImageObservation& row : survey.observations) {
    if (row.photo == photo && row.point == point) {
      return InputError(row.place.path, row.place.line, fault);
    }
  }
  return InputError(place.path, fault);
}

}  // namespace insitu
