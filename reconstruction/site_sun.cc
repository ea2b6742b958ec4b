// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/site_sun.h"

#include <set>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/exif.h"

namespace insitu {
namespace {

constexpr size_t kTimeWithoutOffset = 16;  // letters of "2024-05-15T09:45", the shortest

struct StatedSun {
  std::optional<double> latitude, longitude, altitude;
  std::optional<Eigen::Vector3d> true_north;
  std::optional<std::string> local_time, time_zone;
  std::string source = "site.json";
};

StatedSun ReadStated(const SitePaths& site) {
  StatedSun stated;
  if (!std::filesystem::exists(site.description())) return stated;
  const JsonNode root = JsonNode::Load(site.description());
  if (const auto node = root.Find("latitude")) stated.latitude = node->Number();
  if (const auto node = root.Find("longitude")) stated.longitude = node->Number();
  if (const auto node = root.Find("altitude_m")) stated.altitude = node->Number();
  if (const auto node = root.Find("true_north")) {
    if (node->Vector3().norm() == 0) throw node->Error("expected a direction, not (0, 0, 0)");
    stated.true_north = node->Vector3().normalized();
  }
  if (const auto node = root.Find("local_time")) {
    stated.local_time = node->Text();
    if (!JulianDayOf(node->Text()) && !JulianDayOf(node->Text() + "Z")) {
      throw node->Error("\"" + node->Text() +
                        "\" is no time, expected for example 2024-05-15T09:45:00+02:00");
    }
  }
  if (const auto node = root.Find("time_zone")) {
    stated.time_zone = node->Text();
    if (!JulianDayOf("2024-01-01T00:00:00" + node->Text())) {
      throw node->Error("\"" + node->Text() +
                        "\" is no offset from UTC, expected for example +02:00");
    }
  }
  return stated;
}

// Those that show a shadow first: the sun is theirs.
std::vector<size_t> PhotosByShadows(const SitePhotos& photos, const Survey& survey) {
  std::set<std::string> shadows, showing;
  for (const DirectionPair& pair : survey.sun_pairs) shadows.insert(pair.from);
  for (const ImageObservation& mark : survey.observations) {
    if (shadows.contains(mark.point)) showing.insert(mark.photo);
  }
  std::vector<size_t> order;
  for (const bool shows : {true, false}) {
    for (size_t i = 0; i < photos.names.size(); ++i) {
      if (showing.contains(photos.names[i]) == shows) order.push_back(i);
    }
  }
  return order;
}

void TakeFromPhotographs(const SitePhotos& photos, const Survey& survey, StatedSun* stated) {
  for (const size_t i : PhotosByShadows(photos, survey)) {
    const bool has_place = stated->latitude && stated->longitude;
    if (has_place && stated->local_time) return;
    const ExifPlace place = ReadExifPlace(photos.paths[i]);
    if (!has_place && place.latitude && place.longitude) {
      stated->latitude = place.latitude;
      stated->longitude = place.longitude;
      if (!stated->altitude) stated->altitude = place.altitude;
    }
    if (!stated->local_time && place.local_time) {
      stated->local_time = place.local_time;
      stated->source = "EXIF of photo '" + photos.names[i] + "'";
    }
  }
}

}  // namespace

std::optional<SunCircumstances> SunCircumstancesOf(const SitePaths& site, const SitePhotos& photos,
                                                   const Survey& survey) {
  if (survey.sun_pairs.empty()) return std::nullopt;
  StatedSun stated = ReadStated(site);
  TakeFromPhotographs(photos, survey, &stated);
  if (!stated.latitude || !stated.longitude || !stated.local_time) return std::nullopt;
  SunCircumstances circumstances{{*stated.latitude, *stated.longitude, stated.altitude.value_or(0)},
                                 stated.true_north,
                                 *stated.local_time,
                                 stated.source};
  const bool lacks_offset = circumstances.local_time.size() >= kTimeWithoutOffset &&
                            !JulianDayOf(circumstances.local_time);
  if (lacks_offset && stated.time_zone) circumstances.local_time += *stated.time_zone;
  return circumstances;
}

}  // namespace insitu
