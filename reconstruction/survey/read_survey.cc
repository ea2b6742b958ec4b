// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/read_survey.h"

#include <filesystem>
#include <utility>

#include "calibration/files/plain_text.h"
#include "reconstruction/survey/survey_names.h"
#include "reconstruction/survey/survey_shapes.h"
#include "reconstruction/survey/survey_tables.h"

namespace insitu {
namespace {

// JSON hands names out as they stand, tables in composed form.
void ComposeNames(Survey* survey) {
  const auto compose = [](std::vector<std::string>* names) {
    for (std::string& name : *names) name = Composed(name);
  };
  for (PolygonOutline& polygon : survey->polygons) {
    polygon.name = Composed(polygon.name);
    compose(&polygon.vertices);
    for (auto& hole : polygon.holes) compose(&hole);
  }
  for (auto* pairs : {&survey->sun_pairs, &survey->zenith_pairs}) {
    for (DirectionPair& pair : *pairs) {
      pair.from = Composed(pair.from);
      pair.to = Composed(pair.to);
    }
  }
  for (GeometricConstraint& constraint : survey->constraints) {
    compose(&constraint.points);
    compose(&constraint.polygons);
  }
}

}  // namespace

Survey ReadSurvey(const SitePaths& site, const std::vector<std::string>& photos,
                  SurveyFolder files) {
  const std::filesystem::path folder = site.survey();
  const auto has = [&](const char* file) { return std::filesystem::exists(folder / file); };
  const auto is_to_be_read = [&](const char* file) {
    if (has(file)) return true;
    if (files == SurveyFolder::kRequired) throw InputError(folder / file, "is missing");
    return false;
  };
  Survey survey;
  if (is_to_be_read("control_points.csv")) {
    survey.control_points = ReadControlPoints(folder / "control_points.csv");
  }
  if (is_to_be_read("observations.csv")) {
    survey.observations = ReadObservations(folder / "observations.csv", photos);
  }
  if (has("polygons.json")) {  // poses alone need none
    survey.polygons = ReadPolygons(folder / "polygons.json", photos);
  }
  if (has("directions.json")) {
    DirectionPairs pairs = ReadDirections(folder / "directions.json");
    survey.sun_pairs = std::move(pairs.sun);
    survey.zenith_pairs = std::move(pairs.zenith);
  }
  if (has("camera_positions.csv")) {
    survey.camera_positions = ReadCameraPositions(folder / "camera_positions.csv", photos);
  }
  if (has("edges.csv")) survey.edges = ReadEdges(folder / "edges.csv", photos);
  if (has("constraints.json")) {
    survey.constraints = ReadConstraints(folder / "constraints.json", survey.polygons);
  }
  ComposeNames(&survey);
  RequireKnownPoints(survey);
  RequireNoNamesOfTiePoints(survey);
  LeaveOutLoneMarks(&survey);
  return survey;
}

SurveySoFar ReadSurveySoFar(const SitePaths& site, const std::vector<std::string>& photos) {
  SurveySoFar read;
  const auto try_file = [&](const char* name, const auto& take_in) {
    const std::filesystem::path file = site.survey() / name;
    if (!std::filesystem::exists(file)) return;
    try {
      take_in(file);
    } catch (const InputError& fault) {
      read.faults.push_back(SentenceOf(fault));
    }
  };
  Survey& survey = read.survey;
  using Path = std::filesystem::path;
  try_file("control_points.csv",
           [&](const Path& file) { survey.control_points = ReadControlPoints(file); });
  try_file("observations.csv",
           [&](const Path& file) { survey.observations = ReadObservations(file, photos); });
  try_file("polygons.json",
           [&](const Path& file) { survey.polygons = ReadPolygons(file, photos); });
  try_file("directions.json", [&](const Path& file) {
    DirectionPairs pairs = ReadDirections(file);
    survey.sun_pairs = std::move(pairs.sun);
    survey.zenith_pairs = std::move(pairs.zenith);
  });
  try_file("camera_positions.csv",
           [&](const Path& file) { survey.camera_positions = ReadCameraPositions(file, photos); });
  try_file("edges.csv", [&](const Path& file) { survey.edges = ReadEdges(file, photos); });
  try_file("constraints.json",
           [&](const Path& file) { survey.constraints = ReadConstraints(file, survey.polygons); });
  ComposeNames(&survey);
  return read;
}

}  // namespace insitu
