// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/survey_tables.h"

#include <map>
#include <unordered_map>
#include <utility>

#include "calibration/files/csv_file.h"
#include "calibration/files/error_at.h"
#include "reconstruction/survey/survey_names.h"

namespace insitu {
namespace {

constexpr double kLargestFrame = 100000;  // [px], no photograph is wider or higher

SaidError Fault(const CsvRow& row, const Sentence& what) {
  return ErrorAt({row.path, row.line}, what);
}

double PositiveNumber(const CsvRow& row, const std::string& column) {
  const double value = row.Number(column);
  if (value > 0) return value;
  throw Fault(row, Sentence("cellNotPositive", "{column} is {text}, expected more than 0",
                            {{"column", column}, {"text", row.Text(column)}}));
}

Eigen::Vector3d Position(const CsvRow& row) {
  return {row.Number("x"), row.Number("y"), row.Number("z")};
}

Eigen::Vector3d Sigma(const CsvRow& row) {
  return {PositiveNumber(row, "sigma_x"), PositiveNumber(row, "sigma_y"),
          PositiveNumber(row, "sigma_z")};
}

// The role by its name in the table.
template <typename Role>
Role RoleOf(const CsvRow& row, const std::vector<std::pair<std::string, Role>>& roles) {
  const std::string& text = row.Text("role");
  Sentence expected;
  for (const auto& [name, role] : roles) {
    if (text == name) return role;
    const std::string quoted = "'" + name + "'";
    expected = expected.empty() ? Sentence::Verbatim(quoted)
                                : Sentence("or", "{one} or {other}",
                                           {{"one", expected.ToJson()}, {"other", quoted}});
  }
  throw Fault(row, Sentence("cellRole", "role is '{text}', expected {words}",
                            {{"text", text}, {"words", expected.ToJson()}}));
}

double FrameCoordinate(const CsvRow& row, const std::string& column) {
  const double value = row.Number(column);
  if (value < -0.5 || value > kLargestFrame) {
    throw Fault(row, Sentence("cellPixel",
                              "{column} is {text}, expected a pixel position of the original "
                              "photograph, counted from the centre of its top-left pixel",
                              {{"column", column}, {"text", row.Text(column)}}));
  }
  return value;
}

Eigen::Vector2d Pixel(const CsvRow& row) {
  return {FrameCoordinate(row, "x"), FrameCoordinate(row, "y")};
}

// The photos that rows name, each looked up once: a table may have a million rows.
class PhotosOfRows {
 public:
  explicit PhotosOfRows(const std::vector<std::string>& photos) : photos_(photos) {}

  const std::string& operator()(const CsvRow& row) {
    const std::string& text = row.Text("photo");
    const auto known = names_.find(text);
    if (known != names_.end()) return known->second;
    const std::string photo = SitePhotoName(text, photos_);
    if (const auto fault = FaultOfPhoto(photo, photos_)) throw Fault(row, *fault);
    return names_.emplace(text, photo).first->second;
  }

 private:
  const std::vector<std::string>& photos_;
  std::unordered_map<std::string, std::string> names_;
};

}  // namespace

std::vector<ControlPoint> ReadControlPoints(const std::filesystem::path& path) {
  std::vector<ControlPoint> points;
  std::map<std::string, int> line_of_name;
  for (const CsvRow& row :
       ReadCsv(path, {"name", "x", "y", "z", "sigma_x", "sigma_y", "sigma_z", "role"})) {
    ControlPoint point;
    point.name = row.Text("name");
    point.position = Position(row);
    point.sigma = Sigma(row);
    point.role = RoleOf<ControlRole>(
        row, {{"control", ControlRole::kControl}, {"check", ControlRole::kCheck}});
    point.place = {row.path, row.line};
    const auto [first, is_new] = line_of_name.emplace(point.name, row.line);
    if (!is_new) {
      throw Fault(row, Sentence("pointTwice",
                                "point '{point}' stands already in line {line}, expected each name "
                                "once",
                                {{"point", point.name}, {"line", first->second}}));
    }
    points.push_back(std::move(point));
  }
  return points;
}

std::vector<ImageObservation> ReadObservations(const std::filesystem::path& path,
                                               const std::vector<std::string>& photos) {
  std::vector<ImageObservation> observations;
  std::map<std::pair<std::string, std::string>, int> line_of_mark;
  PhotosOfRows photo_of(photos);
  for (const CsvRow& row : ReadCsv(path, {"photo", "point", "x", "y", "sigma"})) {
    ImageObservation mark{photo_of(row),
                          row.Text("point"),
                          Pixel(row),
                          PositiveNumber(row, "sigma"),
                          {row.path, row.line}};
    const auto [first, is_new] = line_of_mark.emplace(std::pair(mark.photo, mark.point), row.line);
    if (!is_new) {
      throw Fault(
          row, Sentence("markTwice",
                        "point '{point}' is marked on photo '{photo}' already in line {line}, "
                        "expected one mark a photo: remove one row, or name the point it shows",
                        {{"point", mark.point}, {"photo", mark.photo}, {"line", first->second}}));
    }
    observations.push_back(std::move(mark));
  }
  return observations;
}

std::vector<CameraPosition> ReadCameraPositions(const std::filesystem::path& path,
                                                const std::vector<std::string>& photos) {
  std::vector<CameraPosition> positions;
  std::map<std::string, int> line_of_photo;
  PhotosOfRows photo_of(photos);
  for (const CsvRow& row :
       ReadCsv(path, {"photo", "x", "y", "z", "sigma_x", "sigma_y", "sigma_z", "role"})) {
    const PositionRole role = RoleOf<PositionRole>(row, {{"fixed", PositionRole::kFixed},
                                                         {"weighted", PositionRole::kWeighted},
                                                         {"free", PositionRole::kFree}});
    CameraPosition position{photo_of(row), Position(row), Sigma(row), role, {row.path, row.line}};
    const auto [first, is_new] = line_of_photo.emplace(position.photo, row.line);
    if (!is_new) {
      throw Fault(row, Sentence("positionTwice",
                                "photo '{photo}' has a position already in line {line}, expected "
                                "each photo once",
                                {{"photo", position.photo}, {"line", first->second}}));
    }
    positions.push_back(std::move(position));
  }
  return positions;
}

std::vector<EdgeMark> ReadEdges(const std::filesystem::path& path,
                                const std::vector<std::string>& photos) {
  std::vector<EdgeMark> edges;
  PhotosOfRows photo_of(photos);
  for (const CsvRow& row : ReadCsv(path, {"photo", "from", "to", "x", "y", "sigma"})) {
    edges.push_back({photo_of(row),
                     row.Text("from"),
                     row.Text("to"),
                     Pixel(row),
                     PositiveNumber(row, "sigma"),
                     {row.path, row.line}});
    if (edges.back().from == edges.back().to) {
      throw Fault(row, Sentence("edgeItself",
                                "the edge joins point '{point}' with itself, expected two points",
                                {{"point", edges.back().to}}));
    }
  }
  return edges;
}

}  // namespace insitu
