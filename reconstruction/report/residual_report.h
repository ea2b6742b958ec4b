// SPDX-License-Identifier: GPL-3.0-or-later
// The residual report: JSON is the source, the self-contained page is made from it alone. It holds
// no dates, host names or folders: the same input gives the same bytes.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct InputFile {
  std::string name;    // its path below the site folder
  std::string sha256;  // hexadecimal
};

// A point of the montage, such as a planned building's corner; not part of the adjustment.
struct MontagePoint {
  std::string name;
  Eigen::Vector3d position;  // [m], world
};

// What is known of a camera from its calibration.
struct CameraContext {
  std::string model_file;   // its .cameramodel among the inputs
  Json::Value calibration;  // the content of its calibration's report.json, or null
  // The outline within which mrcal calls the lens valid [px]; empty: not known.
  std::vector<Eigen::Vector2d> calibrated_region;
};

// Whether the calibration knows the lens at a pixel: boards were photographed in its cell of the
// frame or, without such a count, mrcal calls it valid there. True if neither is known.
bool IsCalibratedAt(const CameraContext& camera, const Eigen::Vector2d& pixel);

// What the report says besides the adjustment; everything may be missing, and is then said to be.
struct ReportContext {
  AdjustmentOptions options;
  int start_estimates = 0;  // photos that the user placed
  std::string command;  // with its options, without paths
  std::vector<InputFile> inputs;
  std::map<std::string, std::string> programs;    // version of other programs used, by name
  std::map<int, CameraContext> cameras;           // by index into Adjustment::cameras
  std::map<std::string, std::string> thumbnails;  // data URIs to draw on, by photo
  std::vector<MontagePoint> montage;

  const CameraContext& OfCamera(int camera) const;  // nothing known: an empty one
};

Json::Value ResidualReport(const Adjustment& adjustment, const Survey& survey,
                           const ReportContext& context = ReportContext());

// One HTML file without outside references: verdict first, tables and plots.
std::string ResidualPage(const Json::Value& report);

// Every observation, and every point with its covariance: a header line, then one line each.
std::string ObservationsCsv(const Adjustment& adjustment);
std::string PointsCsv(const Adjustment& adjustment);

}  // namespace insitu
