// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_calibration.h"

#include <algorithm>
#include <cstdio>

#include "calibration/error.h"
#include "calibration/json_file.h"
#include "calibration/photograph.h"
#include "calibration/program.h"
#include "calibration/undistort.h"
#include "calibration/whole_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> ListBoardPhotos(const SitePaths& site) {
  std::vector<fs::path> photos;
  if (fs::is_directory(site.boards())) {
    for (const fs::directory_entry& entry : fs::directory_iterator(site.boards())) {
      const fs::path& path = entry.path();
      if (path.filename().string().starts_with("board_") && IsPhotograph(path)) {
        photos.push_back(path);
      }
    }
  }
  if (photos.empty()) {
    throw InputError(
        site.boards(),
        "no calibration, expected camera.cameramodel, or board_* photos and board.txt");
  }
  std::sort(photos.begin(), photos.end());
  return photos;
}

Json::Value ToJson(const ProjectionUncertainty& uncertainty) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Json::Value json;
  json["center_px"] = uncertainty.center_px;
  json["sigma_px"] = insitu::ToJson(Eigen::MatrixXd(Eigen::Map<const RowMajor>(
      uncertainty.sigma_px.data(), uncertainty.rows, uncertainty.columns)));
  return json;
}

Json::Value CalibrationReport(const SiteCalibration& calibration) {
  Json::Value report;
  report["lens_model"] = calibration.camera.lens_model();
  report["width"] = calibration.camera.width();
  report["height"] = calibration.camera.height();
  report["source"] = calibration.boards ? "boards" : "brought";
  if (!calibration.boards) return report;
  const BoardCalibration& boards = *calibration.boards;
  report["boards_given"] = boards.board_photos;
  report["boards_found"] = boards.boards_found;
  report["boards_not_found"] = Json::Value(Json::arrayValue);
  for (const std::string& name : boards.not_found) report["boards_not_found"].append(name);
  report["points"] = boards.points;
  report["outliers"] = boards.outliers;
  report["rms_px"] = boards.rms_px;
  report["worst_px"] = boards.worst_px;
  report["uncertainty"] = ToJson(boards.uncertainty);
  report["splined_lens_model"] = boards.splined_lens_model;
  report["splined_uncertainty"] = ToJson(boards.splined_uncertainty);
  return report;
}

SiteCalibration BroughtCalibration(const SitePaths& site) {
  const Camera camera = ReadCamera(site.brought_camera());
  WriteWhole(site.camera(), ReadWhole(site.brought_camera()));
  return {camera, std::nullopt};
}

SiteCalibration BoardsCalibration(const SitePaths& site, const BoardCalibrationOptions& options) {
  const std::vector<fs::path> photos = ListBoardPhotos(site);
  const Board board = ReadBoard(site.boards() / "board.txt");
  const BoardCalibration boards = CalibrateFromBoards(photos, board, site.camera(), options);
  return {ReadCamera(site.camera()), boards};
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

void CheckPhotoSizes(const std::vector<fs::path>& photos, const Camera& camera) {
  for (const fs::path& photo : photos) {
    const Eigen::Vector2i size = ReadPhotographSize(photo);
    if (size == Eigen::Vector2i(camera.width(), camera.height())) continue;
    throw InputError(photo, "is " + SizeText(size.x(), size.y()) + ", expected " +
                                SizeText(camera.width(), camera.height()) +
                                " as the camera was calibrated");
  }
}

}  // namespace

SiteCalibration CalibrateSite(const SitePaths& site, const BoardCalibrationOptions& options) {
  SiteCalibration calibration = fs::exists(site.brought_camera())
                                    ? BroughtCalibration(site)
                                    : BoardsCalibration(site, options);
  WriteJson(site.calibration_report(), CalibrationReport(calibration));
  return calibration;
}

SiteUndistortion UndistortSite(const SitePaths& site) {
  if (!fs::exists(site.camera())) {
    throw InputError(site.camera(), "no such file, expected insitu-calibrate to have made it");
  }
  RequireResult(site.camera(), "insitu-calibrate");
  const Camera camera = ReadCamera(site.camera());
  const std::vector<fs::path> photos = ListPhotographs(site);
  CheckPhotoSizes(photos, camera);
  const Camera pinhole = PinholeCovering(camera);
  Progress progress("undistorting", static_cast<int>(photos.size()));
  for (const fs::path& photo : photos) {
    const Raster original = ReadPhotograph(photo).linear;
    WriteExr(site.input_image(photo.stem()), Reproject(original, camera, pinhole));
    progress.Step();
  }
  WritePosedCamera(site.pinhole_camera(), {"pinhole", pinhole, Rigid3()},
                   "camera of the undistorted input images");
  return {pinhole, static_cast<int>(photos.size())};
}

std::string SiteCalibration::BriefReport() const {
  if (boards) return boards->BriefReport();
  return camera.lens_model() + ", " + SizeText(camera.width(), camera.height()) +
         ", brought with the site";
}

std::string SiteUndistortion::BriefReport() const {
  char focal[32];
  std::snprintf(focal, sizeof(focal), "%.2f", pinhole.focal_px());
  return std::to_string(photos) + " photographs undistorted to a pinhole of " + focal +
         " px focal length";
}

}  // namespace insitu
