// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/calibration_report.h"

#include <algorithm>

#include "calibration/calibration_page_script.h"
#include "calibration/files/json_file.h"
#include "calibration/program/finding.h"
#include "calibration/program/report_page.h"

namespace insitu {
namespace {

Json::Value Array() { return Json::Value(Json::arrayValue); }

// Row by row; null where there is no number.
template <typename Numbers>
Json::Value Grid(const Numbers& numbers, int columns) {
  Json::Value rows = Array();
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (i % columns == 0) rows.append(Array());
    Json::Value& row = rows[rows.size() - 1];
    if constexpr (requires { numbers[i].has_value(); }) {
      row.append(numbers[i] ? Json::Value(*numbers[i]) : Json::Value());
    } else {
      row.append(numbers[i]);
    }
  }
  return rows;
}

Json::Value JsonOf(const ProjectionUncertainty& uncertainty) {
  Json::Value json;
  json["center_px"] = uncertainty.center_px;
  json["sigma_px"] = Grid(uncertainty.sigma_px, uncertainty.columns);
  return json;
}

Json::Value JsonOf(const ProjectionDifference& difference) {
  Json::Value json;
  json["rms_px"] = difference.rms_px;
  json["largest_px"] = difference.largest_px;
  json["difference_px"] = Grid(difference.px, difference.columns);
  return json;
}

Json::Value JsonOf(const FrameCells& cells) {
  Json::Value json;
  json["counts"] = Grid(cells.counts, cells.columns);
  json["mean_x_px"] = Grid(cells.mean_x_px, cells.columns);
  json["mean_y_px"] = Grid(cells.mean_y_px, cells.columns);
  return json;
}

Json::Value JsonOf(const BoardView& board) {
  Json::Value json;
  json["photo"] = board.photo;
  json["corners"] = board.corners;
  json["outliers"] = board.outliers;
  json["rms_px"] = board.rms_px;
  json["worst_px"] = board.worst_px;
  json["tilt_deg"] = board.tilt_deg;
  json["distance_m"] = board.distance_m;
  return json;
}

void AddLens(const LensAssessment& lens, Json::Value* report) {
  (*report)["points"] = lens.points;
  (*report)["outliers"] = lens.outliers;
  (*report)["rms_px"] = lens.rms_px;
  (*report)["weighted_rms_px"] = lens.weighted_rms_px;
  (*report)["worst_px"] = lens.worst_px;
  (*report)["regularised"] = lens.is_regularised;
  (*report)["board_warp_m"] = Array();
  for (const double warp : lens.board_warp_m) (*report)["board_warp_m"].append(warp);
  (*report)["uncertainty"] = JsonOf(lens.uncertainty);
  (*report)["cells"] = JsonOf(lens.cells);
  (*report)["boards"] = Array();
  for (const BoardView& board : lens.boards) (*report)["boards"].append(JsonOf(board));
  if (lens.intrinsics_covariance) {
    (*report)["intrinsics_covariance"] = ToJson(*lens.intrinsics_covariance);
  }
}

void AddBoards(const BoardCalibration& boards, Json::Value* report) {
  (*report)["boards_given"] = boards.board_photos;
  (*report)["boards_found"] = boards.boards_found;
  (*report)["boards_not_found"] = Array();
  for (const std::string& name : boards.not_found) (*report)["boards_not_found"].append(name);
  (*report)["splined_lens_model"] = boards.splined_lens_model;
  (*report)["splined_rms_px"] = boards.splined.rms_px;
  (*report)["splined_outliers"] = boards.splined.outliers;
  (*report)["splined_uncertainty"] = JsonOf(boards.splined.uncertainty);
  (*report)["splined_difference"] = JsonOf(boards.splined_difference);
  if (boards.halves) (*report)["cross_validation"] = JsonOf(*boards.halves);
}

Json::Value JsonOf(const FilmScan& scan) {
  Json::Value json;
  const bool is_affine = scan.map.transformation == FilmTransformation::kAffine;
  json["transformation"] = is_affine ? "affine" : "projective";
  json["bitmap_from_image"] = ToJson(Eigen::MatrixXd(scan.map.bitmap_from_image));
  if (scan.map.sigma_px) json["sigma_px"] = *scan.map.sigma_px;
  json["focal_mm"] = scan.film.focal_mm;
  json["principal_point_mm"] = ToJson(Eigen::VectorXd(scan.film.principal_point_mm));
  json["distortion"] = Array();
  for (const Eigen::Vector2d& row : scan.film.distortion) {
    json["distortion"].append(ToJson(Eigen::VectorXd(row)));
  }
  const Eigen::AngleAxisd turn(scan.fit.fit_from_lens);
  json["scan_turn_rad"] = ToJson(Eigen::VectorXd(turn.angle() * turn.axis()));
  json["fiducials"] = Array();
  for (size_t i = 0; i < scan.marks.size(); ++i) {
    Json::Value mark;
    mark["mark"] = scan.marks[i].mark;
    mark["image_mm"] = ToJson(Eigen::VectorXd(scan.marks[i].image_mm));
    mark["bitmap_px"] = ToJson(Eigen::VectorXd(scan.marks[i].bitmap_px));
    mark["residual_px"] = ToJson(Eigen::VectorXd(scan.map.residuals_px[i]));
    json["fiducials"].append(mark);
  }
  return json;
}

std::string SourceOf(const CameraCalibration& calibration) {
  if (calibration.boards) return "boards";
  if (calibration.scan) return "film";
  return calibration.file ? "brought" : "exif";
}

}  // namespace

Json::Value CalibrationReport(const CameraCalibration& calibration) {
  Json::Value report;
  report["camera"] = calibration.name;
  report["lens_model"] = calibration.camera.lens_model();
  report["width"] = calibration.camera.width();
  report["height"] = calibration.camera.height();
  report["intrinsics"] = Array();
  for (const double value : calibration.camera.intrinsics()) report["intrinsics"].append(value);
  report["intrinsics_names"] = Array();
  for (const std::string& name : calibration.camera.IntrinsicsNames()) {
    report["intrinsics_names"].append(name);
  }
  report["source"] = SourceOf(calibration);
  report["photos"] = Array();
  for (const std::string& photo : calibration.photos) report["photos"].append(photo);
  report["verdict"] = VerdictReport(calibration.findings);
  if (calibration.file) {
    report["format"] = calibration.file->format;
    report["largest_deviation_px"] = calibration.file->largest_deviation_px;
  }
  if (calibration.scan) {
    report["film"] = JsonOf(*calibration.scan);
    report["largest_deviation_px"] = calibration.scan->fit.largest_deviation_px;
  }
  if (calibration.lens) AddLens(*calibration.lens, &report);
  if (calibration.boards) AddBoards(*calibration.boards, &report);
  return report;
}

std::string CalibrationPage(const Json::Value& report) {
  const std::string camera = report["camera"].asString();
  return ReportPage(camera.empty() ? "Calibration" : "Calibration: " + camera, report,
                    kCalibrationPageScript);
}

std::optional<Eigen::MatrixXd> ReadIntrinsicsCovariance(const SitePaths& site,
                                                        const std::string& camera) {
  const std::filesystem::path path = site.calibration_report(camera);
  if (!std::filesystem::exists(path)) return std::nullopt;
  const JsonNode report = JsonNode::Load(path);
  const auto node = report.Find("intrinsics_covariance");
  if (!node) return std::nullopt;
  Eigen::MatrixXd covariance = node->Matrix();
  const auto count = static_cast<Eigen::Index>(report.At("intrinsics").Items().size());
  if (covariance.rows() == count && covariance.cols() == count) return covariance;
  throw node->Error("is not " + std::to_string(count) + " x " + std::to_string(count) +
                    " as the intrinsics are many; run insitu-calibrate again");
}

}  // namespace insitu
