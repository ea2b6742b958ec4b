// SPDX-License-Identifier: GPL-3.0-or-later
// Files of other programs become a site's survey/control_points.csv, observations.csv and
// camera_positions.csv: merged, in metres of one coordinate system, every value with its sigma.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/exchange/survey_file.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct SurveyImportOptions {
  std::optional<double> sigma_m;        // of points whose file states none
  std::optional<double> mark_sigma_px;  // of marks whose file states none
  std::optional<std::string> file_crs;  // the system of files that name none
  std::optional<std::string> crs;  // to convert to; nullopt: as read, or the UTM zone of degrees
  SurveyReading reading;           // of tables with a header
  std::map<std::string, std::string> photo_names;  // the files' name -> the site's
  std::set<std::string> check_points;              // kept out of the adjustment
  bool keeps_unsurveyed = false;  // marks of points without coordinates: polygons' vertices
  bool may_replace = false;       // survey files that are there already

  void Check() const;  // throws CheckError that names the field: a sigma that is not above 0
};

struct SurveyImport {
  std::vector<ControlPoint> control_points;
  std::vector<ImageObservation> observations;
  std::vector<CameraPosition> camera_positions;  // weighted
  std::vector<std::string> report;               // what was read, converted and left out, in words
};

// `photos` are the site's, `photo_size` their sizes. Heights are never converted. Throws
// InputError: as ReadSurveyFile; systems that are mixed, unknown, in feet, or cannot be converted;
// a sigma that is stated nowhere; one name at two places; two marks of a point on a photo; no mark
// on any photo of the site; a check point that no file holds.
SurveyImport ImportSurvey(const std::vector<std::filesystem::path>& files,
                          const std::set<std::string>& photos, const PhotoSize& photo_size,
                          const SurveyImportOptions& options);

// Reads `files` for a site and writes the survey files that they fill; the others stay. Throws
// InputError as above, or if a file is there already and may not be replaced; nothing is written
// then.
SurveyImport ImportSurveyInto(const SitePaths& site,
                              const std::vector<std::filesystem::path>& files,
                              const SurveyImportOptions& options);

}  // namespace insitu
