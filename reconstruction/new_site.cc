// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/new_site.h"

#include <algorithm>
#include <optional>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/exif.h"
#include "reconstruction/site_schemas.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr char kControlTemplate[] =
    R"(# Surveyed points, one a row: in metres, x east, y north, z up, or any right-handed axes alike.
# sigma_x, sigma_y, sigma_z: standard deviations [m]. role: control takes part in the adjustment, check
# verifies it. At least three on each photograph, not on one line; six or more make errors findable.
# church_door_left,2600012.345,1200034.567,431.210,0.010,0.010,0.015,control
name,x,y,z,sigma_x,sigma_y,sigma_z,role
)";
constexpr char kMarksTemplate[] =
    R"(# Where points appear, one mark a row: the photograph's name without ending, the point's name, and its
# place in pixels of the original file; (0, 0) is the centre of the top left pixel, y counts downwards.
# sigma: standard deviation [px], 0.5 of a sharp corner. `insitu prepare SITE` writes this file.
# IMG_0001,church_door_left,1204.3,877.9,0.5
photo,point,x,y,sigma
)";
constexpr char kPolygonsTemplate[] = R"({
 "$schema": "../schemas/polygons.schema.json",
 "comment": "Ground, walls and roofs, each by its points' names counter-clockwise seen from outside, e.g. {\"name\": \"square\", \"vertices\": [\"a\", \"b\", \"c\", \"d\"], \"photo\": \"IMG_0001\", \"material\": \"asphalt\"}",
 "polygons": []
}
)";
constexpr char kDirectionsTemplate[] = R"({
 "$schema": "../schemas/directions.schema.json",
 "comment": "sun: a point and its shadow, e.g. {\"object\": \"post_top\", \"shadow\": \"post_tip\"}; zenith: the ends of plumb edges, e.g. {\"bottom\": \"corner_0\", \"top\": \"corner_1\"}",
 "sun": [],
 "zenith": []
}
)";
constexpr char kConstraintsTemplate[] = R"({
 "$schema": "../schemas/constraints.schema.json",
 "comment": "What is known besides coordinates, e.g. {\"kind\": \"distance\", \"points\": [\"a\", \"b\"], \"value_m\": 12.345, \"sigma_m\": 0.003}; further kinds: height, vertical, horizontal, parallel, perpendicular",
 "constraints": []
}
)";
constexpr char kSamplesTemplate[] = R"({
 "$schema": "../schemas/samples.schema.json",
 "comment": "Pixels from which light is measured, e.g. {\"photo\": \"IMG_0001\", \"x\": 1204, \"y\": 877, \"polygon\": \"square\"}: horizon of the sky (no polygon), haze of one material at different distances (or null), daylight of one material in the sun and in the shade",
 "horizon": [],
 "haze": null,
 "daylight": []
}
)";
constexpr char kMaterialsTemplate[] = R"({
 "$schema": "../schemas/materials.schema.json",
 "comment": "What photographs cannot tell of a polygon's material, e.g. {\"water\": {\"use\": \"water\", \"roughness\": 0.05}}; insitu materials lists the library",
 "materials": {}
}
)";

struct Template {
  const char* file;
  const char* text;
};
constexpr Template kTemplates[] = {{"survey/control_points.csv", kControlTemplate},
                                   {"survey/observations.csv", kMarksTemplate},
                                   {"survey/polygons.json", kPolygonsTemplate},
                                   {"survey/directions.json", kDirectionsTemplate},
                                   {"survey/constraints.json", kConstraintsTemplate},
                                   {"survey/samples.json", kSamplesTemplate},
                                   {"survey/materials.json", kMaterialsTemplate}};

std::vector<fs::path> PhotographsIn(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder, "is no folder, expected photographs");
  std::vector<fs::path> photographs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (IsPhotograph(entry.path())) photographs.push_back(entry.path());
  }
  std::sort(photographs.begin(), photographs.end());
  if (!photographs.empty()) return photographs;
  throw InputError(folder, "holds no photographs, expected JPEG, PNG, TIFF or EXR files");
}

// Those that are not in photos/ yet.
std::vector<fs::path> PhotographsToCopy(const SitePaths& site, const fs::path& folder) {
  std::vector<fs::path> missing;
  for (const fs::path& photo : PhotographsIn(folder)) {
    const fs::path own = site.photos() / photo.filename();
    if (!fs::exists(own)) {
      missing.push_back(photo);
    } else if (ReadWhole(own) != ReadWhole(photo)) {
      throw InputError(photo, "stands in " + site.photos().string() +
                                  " already with another content, expected each name once");
    }
  }
  return missing;
}

// What the first photograph that states its place, and the first that states its time, say.
ExifPlace PlaceOf(const std::vector<fs::path>& photos) {
  ExifPlace place;
  for (const fs::path& photo : photos) {
    const ExifPlace stated = ReadExifPlace(photo);
    if (!place.latitude && stated.latitude && stated.longitude) {
      place.latitude = stated.latitude;
      place.longitude = stated.longitude;
      place.altitude = stated.altitude;
    }
    if (!place.local_time) place.local_time = stated.local_time;
    if (place.latitude && place.local_time) break;
  }
  return place;
}

std::string SiteText(const SitePaths& site, const ExifPlace& place) {
  const fs::path folder = site.root.filename().empty() ? site.root.parent_path() : site.root;
  Json::Value name = fs::absolute(folder).filename().string();
  std::string text =
      "{\n \"$schema\": \"schemas/site.schema.json\",\n"
      " \"comment\": \"place and time of the photographs that show shadows: the sun measured on "
      "them is held against the almanac. Further keys: time_zone (+02:00), true_north [x, y, z], "
      "cameras {photo: folder of calibration/}, report_points\",\n \"name\": " +
      name.toStyledString();
  text.pop_back();  // its line break
  if (place.latitude && place.longitude) {
    text += Formatted(",\n \"latitude\": %.6f,\n \"longitude\": %.6f", *place.latitude,
                      *place.longitude);
  }
  if (place.altitude) text += Formatted(",\n \"altitude_m\": %.1f", *place.altitude);
  if (place.local_time) text += ",\n \"local_time\": \"" + *place.local_time + "\"";
  return text + "\n}\n";
}

std::vector<std::string> WhatIsNext(const SitePaths& site, size_t photos, const ExifPlace& place) {
  std::vector<std::string> remarks = {std::to_string(photos) +
                                      (photos == 1 ? " photograph" : " photographs") + " in " +
                                      site.photos().string()};
  if (!place.latitude) {
    remarks.emplace_back(
        "no photograph states its place: write latitude and longitude into "
        "site.json, or the sun is not checked");
  }
  if (!place.local_time) {
    remarks.emplace_back("no photograph states its time: write local_time into site.json");
  }
  remarks.push_back(
      "next: photographs of a chessboard as calibration/board_*.jpg with "
      "calibration/board.txt, or a camera file; insitu prepare " +
      site.root.string() + " measures; the building goes into building/");
  return remarks;
}

void WriteIfMissing(const SitePaths& site, const std::string& file, const std::string& text,
                    NewSite* made) {
  if (fs::exists(site.root / file)) return;
  WriteWhole(site.root / file, text);
  made->written.push_back(file);
}

}  // namespace

NewSite MakeNewSite(const SitePaths& site, const fs::path& photographs) {
  std::vector<fs::path> to_copy;
  if (!photographs.empty()) to_copy = PhotographsToCopy(site, photographs);
  if (to_copy.empty() && !fs::is_directory(site.photos())) {
    throw InputError(site.photos(),
                     "no such folder, expected the site's photographs in it, or --photos FOLDER");
  }
  NewSite made;
  fs::create_directories(site.photos());
  for (const fs::path& photo : to_copy) {
    const fs::path name = photo.filename();
    WriteWhole(site.photos() / name, ReadWhole(photo));
    made.written.push_back("photos/" + name.string());
  }
  const std::vector<fs::path> photos = ListPhotographs(site);
  const ExifPlace place = PlaceOf(photos);
  WriteIfMissing(site, "site.json", SiteText(site, place), &made);
  for (const Template& each : kTemplates) WriteIfMissing(site, each.file, each.text, &made);
  for (const SiteSchema& schema : kSiteSchemas) {
    WriteIfMissing(site, std::string("schemas/") + schema.name, schema.text, &made);
  }
  fs::create_directories(site.boards());
  fs::create_directories(site.building());
  made.remarks = WhatIsNext(site, photos.size(), place);
  return made;
}

}  // namespace insitu
