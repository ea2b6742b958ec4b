// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "calibration/files/error_at.h"
#include "calibration/files/json_file.h"
#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {
namespace {

void ReadPosition(const JsonNode& point, const std::string& id, SurveyFile* file) {
  const auto position = point.Find("position");
  if (!position) return;
  const auto altitude = position->Find("altitude");
  if (!altitude) {
    file->remarks.push_back(Sentence(
        "remarkNoAltitude", "point \"{point}\" has no altitude and is left out", {{"point", id}}));
    return;
  }
  SurveyedPoint surveyed;
  surveyed.name = id;
  surveyed.position = {position->At("longitude").Number(), position->At("latitude").Number(),
                       altitude->Number()};
  surveyed.place = {position->path(), position->line()};
  file->points.push_back(surveyed);
}

// From the middle of the picture, over its larger side. [OpenSfM, doc/source/geometry.rst]
SurveyedMark ReadMark(const JsonNode& observation, const std::string& id,
                      const Eigen::Vector2i& size) {
  const JsonNode projection = observation.At("projection");
  const std::vector<double> normalized = projection.Numbers();
  const FilePlace place{projection.path(), projection.line()};
  if (normalized.size() != 2) throw ErrorAt(place, Sentence("openSfmTwo", "expected two numbers"));
  const Eigen::Vector2d middle = (size.cast<double>().array() - 1) / 2;
  const Eigen::Vector2d offset = Eigen::Vector2d(normalized[0], normalized[1]) * size.maxCoeff();
  if (std::max(std::abs(normalized[0]), std::abs(normalized[1])) > 0.5001) {
    throw ErrorAt(place, Sentence("openSfmOff",
                                  "lies off the picture, expected -0.5 to 0.5 of its larger side"));
  }
  return {PhotoName(observation.At("shot_id").Text()),
          id,
          middle + offset,
          std::nullopt,
          {observation.path(), observation.line()}};
}

}  // namespace

SurveyFile ReadOpenSfmJson(const std::filesystem::path& path, const PhotoSize& photo_size) {
  SurveyFile file;
  file.format = "ground_control_points.json of OpenSfM";
  file.crs = "EPSG:4326";
  int unseen = 0;
  const JsonNode points = JsonNode::Load(path).At("points");
  for (const JsonNode& point : points.Items()) {
    const std::string id = point.At("id").Text();
    ReadPosition(point, id, &file);
    for (const JsonNode& observation : point.At("observations").Items()) {
      const auto size = photo_size(PhotoName(observation.At("shot_id").Text()));
      if (!size && ++unseen) continue;
      file.marks.push_back(ReadMark(observation, id, *size));
    }
  }
  if (unseen) {
    file.remarks.push_back(Sentence("remarkNoPhoto",
                                    "{count} marks are on photos that are not in the folder photos",
                                    {{"count", unseen}}));
  }
  return file;
}

}  // namespace insitu
