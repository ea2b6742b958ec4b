// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/solution_errors.h"

#include <set>

#include "calibration/files/error_at.h"
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

Sentence Remedy(Unknown::Kind kind) {
  switch (kind) {
    case Unknown::Kind::kCamera:
      return Sentence("remedyCamera",
                      "more photos from other sides, or a lens model of fewer parameters "
                      "(insitu-calibrate --lens-model LENSMODEL_OPENCV4)");
    case Unknown::Kind::kPhoto:
      return Sentence("remedyPhoto",
                      "more marks of well spread points on it, or its surveyed position");
    case Unknown::Kind::kPoint:
      return Sentence("remedyPoint",
                      "a mark of it on one more photo, its surveyed coordinates, or a polygon "
                      "whose plane holds it");
    case Unknown::Kind::kPlane:
      return Sentence("remedyPlane",
                      "three of its vertices determined by marks or survey, not on one line");
    case Unknown::Kind::kDirection:
      break;
  }
  return Sentence("remedyDirection", "more pairs of points in directions.json");
}

Sentence NameOf(const Unknown& unknown, const Network& network) {
  switch (unknown.kind) {
    case Unknown::Kind::kCamera:
      return Sentence("unknownCamera", "camera {name}",
                      {{"name", network.cameras[unknown.index].name}});
    case Unknown::Kind::kPhoto:
      return Sentence("unknownPhoto", "photo {name}",
                      {{"name", network.photos[unknown.index].name}});
    case Unknown::Kind::kPoint:
      return Sentence("unknownPoint", "point {name}",
                      {{"name", network.points[unknown.index].name}});
    case Unknown::Kind::kPlane:
      return Sentence("unknownPlane", "the plane of polygon {name}",
                      {{"name", network.planes[unknown.index].name}});
    case Unknown::Kind::kDirection:
      break;
  }
  return network.directions[unknown.index].name == "sun"
             ? Sentence("unknownSun", "the direction to the sun")
             : Sentence("unknownZenith", "the direction to the zenith");
}

}  // namespace

SaidError RankDefectError(const RankDefect& defect, const SurveyNetwork& survey_network,
                          const Survey& survey) {
  std::set<std::string> names;
  for (const RankDefect::Column& column : defect.columns) {
    names.insert(ColumnNames(survey_network.network, column.unknown)
                     .at(static_cast<size_t>(column.component)));
  }
  const Unknown& first = defect.columns.front().unknown;
  const FilePlace place = PlaceOf(first, survey_network, survey);
  const Sentence remedy = Remedy(first.kind);
  return {InputError(
              place.path, place.line,
              Listing("the observations do not determine unknowns", {names.begin(), names.end()}) +
                  "; expected " + remedy.text()),
          place,
          Sentence("notDetermined",
                   "the observations do not determine {what} ({count} unknowns in all); expected "
                   "{remedy}",
                   {{"what", NameOf(first, survey_network.network).ToJson()},
                    {"count", Json::UInt64(names.size())},
                    {"remedy", remedy.ToJson()}})};
}

SaidError NoSolutionError(const NoSolution& failure, const Network& network, const Survey& survey) {
  const FilePlace place = PlaceOfObservations(survey);
  if (!failure.row || failure.row->kind != ObservationRow::Kind::kMark) {
    return ErrorAt({place.path}, Sentence("adjustmentFails",
                                          "the adjustment fails: {why}, expected marks that fit "
                                          "their points",
                                          {{"why", failure.what()}}));
  }
  const MarkObservation& mark = network.marks[failure.row->index];
  const std::string &photo = network.photos[mark.photo].name,
                    &point = network.points[mark.point].name;
  const Sentence fault("pointBehind",
                       "point '{point}' lies behind photo '{photo}' that shows it, expected "
                       "another point or another place of the photo: is the mark under the right "
                       "name?",
                       {{"point", point}, {"photo", photo}});
  for (const ImageObservation& row : survey.observations) {
    if (row.photo == photo && row.point == point) {
      return ErrorAt(row.place, fault);
    }
  }
  return ErrorAt({place.path}, fault);
}

}  // namespace insitu
