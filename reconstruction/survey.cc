// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey.h"

#include <algorithm>
#include <set>
#include <utility>

#include "calibration/csv_file.h"

namespace insitu {
namespace {

constexpr double kLargestFrame = 100000;  // [px], no photograph is wider or higher

double PositiveNumber(const CsvRow& row, const std::string& column) {
  const double value = row.Number(column);
  if (value <= 0) throw row.Error(column + " is " + row.Text(column) + ", expected more than 0");
  return value;
}

ControlRole Role(const CsvRow& row) {
  const std::string& role = row.Text("role");
  if (role == "control") return ControlRole::kControl;
  if (role == "check") return ControlRole::kCheck;
  throw row.Error("role is '" + role + "', expected 'control' or 'check'");
}

std::vector<ControlPoint> ReadControlPoints(const std::filesystem::path& path) {
  std::vector<ControlPoint> points;
  std::map<std::string, int> line_of_name;
  for (const CsvRow& row :
       ReadCsv(path, {"name", "x", "y", "z", "sigma_x", "sigma_y", "sigma_z", "role"})) {
    ControlPoint point;
    point.name = row.Text("name");
    point.position = {row.Number("x"), row.Number("y"), row.Number("z")};
    point.sigma = {PositiveNumber(row, "sigma_x"), PositiveNumber(row, "sigma_y"),
                   PositiveNumber(row, "sigma_z")};
    point.role = Role(row);
    point.place = {row.path, row.line};
    const auto [first, is_new] = line_of_name.emplace(point.name, row.line);
    if (!is_new) {
      throw row.Error("point '" + point.name + "' stands already in line " +
                      std::to_string(first->second) + ", expected each name once");
    }
    points.push_back(std::move(point));
  }
  return points;
}

double FrameCoordinate(const CsvRow& row, const std::string& column) {
  const double value = row.Number(column);
  if (value < -0.5 || value > kLargestFrame) {
    throw row.Error(column + " is " + row.Text(column) +
                    ", expected a pixel position of the original photograph");
  }
  return value;
}

std::vector<ImageObservation> ReadObservations(const std::filesystem::path& path,
                                               const std::vector<std::string>& photos) {
  std::vector<ImageObservation> observations;
  std::map<std::pair<std::string, std::string>, int> line_of_mark;
  for (const CsvRow& row : ReadCsv(path, {"photo", "point", "x", "y", "sigma"})) {
    ImageObservation mark{row.Text("photo"),
                          row.Text("point"),
                          {FrameCoordinate(row, "x"), FrameCoordinate(row, "y")},
                          PositiveNumber(row, "sigma"),
                          {row.path, row.line}};
    if (std::find(photos.begin(), photos.end(), mark.photo) == photos.end()) {
      throw row.Error("photo '" + mark.photo + "' is not in the folder photos");
    }
    const auto [first, is_new] = line_of_mark.emplace(std::pair(mark.photo, mark.point), row.line);
    if (!is_new) {
      throw row.Error("point '" + mark.point + "' is marked on photo '" + mark.photo +
                      "' already in line " + std::to_string(first->second) +
                      ", expected one mark a photo");
    }
    observations.push_back(std::move(mark));
  }
  return observations;
}

std::optional<std::string> ReadMask(const JsonNode& polygon) {
  const auto mask = polygon.Find("mask");
  if (!mask) return std::nullopt;
  if (!std::filesystem::exists(polygon.path().parent_path() / mask->Text())) {
    throw mask->Error("mask '" + mask->Text() + "' is not in the folder survey");
  }
  return mask->Text();
}

PolygonOutline ReadPolygon(const JsonNode& node, const std::vector<std::string>& photos) {
  PolygonOutline polygon;
  polygon.name = node.At("name").Text();
  polygon.place = {node.path(), node.line()};
  const JsonNode vertices = node.At("vertices");
  for (const JsonNode& vertex : vertices.Items()) polygon.vertices.push_back(vertex.Text());
  const std::set<std::string> distinct(polygon.vertices.begin(), polygon.vertices.end());
  if (distinct.size() < 3 || distinct.size() < polygon.vertices.size()) {
    throw node.Error("polygon '" + polygon.name + "' has " +
                     std::to_string(polygon.vertices.size()) + " vertices, " +
                     std::to_string(distinct.size()) +
                     " of them distinct; expected at least three, all distinct");
  }
  if (const auto photo = node.Find("photo")) {
    polygon.photo = photo->Text();
    if (std::find(photos.begin(), photos.end(), *polygon.photo) == photos.end()) {
      throw photo->Error("photo '" + *polygon.photo + "' is not in the folder photos");
    }
  }
  polygon.material = node.At("material").Text();
  polygon.mask = ReadMask(node);
  return polygon;
}

std::vector<PolygonOutline> ReadPolygons(const std::filesystem::path& path,
                                         const std::vector<std::string>& photos) {
  std::vector<PolygonOutline> polygons;
  std::set<std::string> names;
  for (const JsonNode& node : JsonNode::Load(path).At("polygons").Items()) {
    polygons.push_back(ReadPolygon(node, photos));
    if (!names.insert(polygons.back().name).second) {
      throw node.Error("polygon '" + polygons.back().name + "' occurs twice");
    }
  }
  return polygons;
}

std::vector<DirectionPair> ReadPairs(const JsonNode& root, const std::string& key,
                                     const std::string& from, const std::string& to) {
  std::vector<DirectionPair> pairs;
  const auto list = root.Find(key);
  if (!list) return pairs;
  for (const JsonNode& node : list->Items()) {
    pairs.push_back({node.At(from).Text(), node.At(to).Text(), {node.path(), node.line()}});
    if (pairs.back().from == pairs.back().to) {
      throw node.Error("the pair names point '" + pairs.back().to + "' twice, expected two points");
    }
  }
  return pairs;
}

std::set<std::string> NamesMadeElsewhere(const Survey& survey) {
  std::set<std::string> names;
  for (const ControlPoint& point : survey.control_points) names.insert(point.name);
  for (const PolygonOutline& polygon : survey.polygons) {
    names.insert(polygon.vertices.begin(), polygon.vertices.end());
  }
  for (const auto* pairs : {&survey.sun_pairs, &survey.zenith_pairs}) {
    for (const DirectionPair& pair : *pairs) names.insert({pair.from, pair.to});
  }
  return names;
}

void RequireKnownPoints(const Survey& survey) {
  const std::set<std::string> known = NamesMadeElsewhere(survey);
  for (const ImageObservation& mark : survey.observations) {
    if (known.contains(mark.point)) continue;
    throw InputError(mark.place.path, mark.place.line,
                     "point '" + mark.point +
                         "' is unknown, expected a point of control_points.csv, polygons.json or "
                         "directions.json");
  }
}

}  // namespace

Survey ReadSurvey(const SitePaths& site, const std::vector<std::string>& photos,
                  SurveyFiles files) {
  const auto is_to_be_read = [&](const char* file) {
    return files == SurveyFiles::kRequired || std::filesystem::exists(site.survey() / file);
  };
  Survey survey;
  if (is_to_be_read("control_points.csv")) {
    survey.control_points = ReadControlPoints(site.survey() / "control_points.csv");
  }
  if (is_to_be_read("observations.csv")) {
    survey.observations = ReadObservations(site.survey() / "observations.csv", photos);
  }
  if (is_to_be_read("polygons.json")) {
    survey.polygons = ReadPolygons(site.survey() / "polygons.json", photos);
  }
  const std::filesystem::path directions = site.survey() / "directions.json";
  if (std::filesystem::exists(directions)) {
    const JsonNode root = JsonNode::Load(directions);
    survey.sun_pairs = ReadPairs(root, "sun", "shadow", "object");
    survey.zenith_pairs = ReadPairs(root, "zenith", "bottom", "top");
  }
  RequireKnownPoints(survey);
  return survey;
}

FilePlace PlaceOfPoint(const Survey& survey, const std::string& name) {
  for (const ImageObservation& mark : survey.observations) {
    if (mark.point == name) return mark.place;
  }
  for (const ControlPoint& point : survey.control_points) {
    if (point.name == name) return point.place;
  }
  for (const PolygonOutline& polygon : survey.polygons) {
    const auto& vertices = polygon.vertices;
    if (std::find(vertices.begin(), vertices.end(), name) != vertices.end()) return polygon.place;
  }
  for (const auto* pairs : {&survey.sun_pairs, &survey.zenith_pairs}) {
    for (const DirectionPair& pair : *pairs) {
      if (pair.from == name || pair.to == name) return pair.place;
    }
  }
  throw CheckError(__FILE__, __LINE__, "the point is in the survey");
}

}  // namespace insitu
