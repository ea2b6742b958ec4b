// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/calibration_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "calibration/boards/lens_assessment.h"
#include "calibration/camera_files/read_camera_file.h"
#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/lens/projection_difference.h"
#include "calibration/program/external_program.h"
#include "calibration/site_calibration.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

Json::Value RmsOf(const fs::path& model, const fs::path& work) {
  const LensAssessment lens = AssessLens(model, work);
  Json::Value json;
  json["rms_px"] = lens.weighted_rms_px;
  json["unweighted_rms_px"] = lens.rms_px;
  json["points"] = lens.points;
  json["outliers"] = lens.outliers;
  return json;
}

// A site with nothing but the board photographs that start with `prefix`.
SitePaths BoardSite(const fs::path& pictures, const std::string& prefix, const std::string& board,
                    const fs::path& folder) {
  const SitePaths site{folder};
  fs::create_directories(site.boards());
  for (const fs::directory_entry& entry : fs::directory_iterator(pictures)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || entry.path().extension() != ".jpg") continue;
    fs::copy_file(entry.path(), site.boards() / ("board_" + name),
                  fs::copy_options::overwrite_existing);
  }
  WriteWhole(site.boards() / "board.txt", "type chessboard\n" + board);
  return site;
}

// What another lens leaves in the corners that ours was made from.
double RmsOfLens(const SitePaths& site, const Camera& theirs) {
  const fs::path model = site.root / "theirs.cameramodel", output = site.root / "theirs.txt";
  WritePosedCamera(model, {"", theirs, Rigid3()}, "theirs");
  RunExternal({.command = {"/usr/bin/python3", INSITU_ROOT "/tests/benchmarks/rms_of_lens.py",
                           fs::absolute(site.camera()).string(), fs::absolute(model).string()},
               .package = "python3-mrcal",
               .folder = site.root,
               .output = output,
               .log = site.root / "theirs.log"});
  return std::stod(ReadWhole(output));
}

// A lens of BoofCV's kind, fitted to the corners that ours was made from.
Camera LensOfTheirKind(const SitePaths& site, const Camera& ours) {
  const fs::path output = site.root / "their_kind.txt";
  RunExternal({.command = {"/usr/bin/python3", INSITU_ROOT "/tests/benchmarks/lens_of_corners.py",
                           fs::absolute(site.camera()).string()},
               .package = "python3-opencv",
               .folder = site.root,
               .output = output,
               .log = site.root / "their_kind.log"});
  std::istringstream words(ReadWhole(output));
  std::vector<double> intrinsics(9);
  for (double& value : intrinsics) words >> value;
  if (!words) throw InputError(output, "expected nine numbers");
  return Camera("LENSMODEL_OPENCV5", intrinsics, ours.width(), ours.height());
}

Json::Value AgainstTheirs(const SitePaths& site, const fs::path& file, bool has_no_tangential) {
  const CameraCalibration ours = CalibrateSite(site).cameras.front();
  const Camera theirs = ReadCameraFile(file).camera;
  const ProjectionUncertainty& sigma = ours.boards->splined.uncertainty;
  std::vector<double> weights;
  for (const auto& node : sigma.sigma_px) weights.push_back(node ? 1 / (*node * *node) : 0);
  const ProjectionDifference difference =
      CompareLenses(ours.camera, theirs, sigma.columns, sigma.rows, weights);
  const Camera same_kind_lens =
      has_no_tangential ? LensOfTheirKind(site, ours.camera) : ours.camera;
  const ProjectionDifference same_kind =
      CompareLenses(same_kind_lens, theirs, sigma.columns, sigma.rows, weights);
  double sum = 0, same_kind_sum = 0, sigmas = 0, largest = 0;
  int seen = 0;
  for (size_t i = 0; i < difference.px.size(); ++i) {
    if (ours.lens->cells.counts[i] == 0 || !difference.px[i] || !sigma.sigma_px[i]) continue;
    same_kind_sum += same_kind.px[i].value() * same_kind.px[i].value();
    sum += *difference.px[i] * *difference.px[i];
    sigmas += *sigma.sigma_px[i] * *sigma.sigma_px[i];
    largest = std::max(largest, *difference.px[i]);
    ++seen;
  }
  Json::Value json;
  json["boards"] = ours.boards->boards_found;
  json["rms_px"] = ours.lens->rms_px;
  json["their_rms_px"] = RmsOfLens(site, theirs);
  json["difference_rms_px"] = difference.rms_px;
  json["difference_largest_px"] = difference.largest_px;
  json["seen_rms_px"] = std::sqrt(sum / seen);
  json["seen_largest_px"] = largest;
  if (has_no_tangential) json["same_kind_seen_rms_px"] = std::sqrt(same_kind_sum / seen);
  json["sigma_seen_px"] = std::sqrt(sigmas / seen);
  return json;
}

}  // namespace

std::optional<fs::path> SharedFolder() {
  const char* named = std::getenv("INSITU_SHARED");
  const fs::path shared = named ? fs::path(named) : fs::path(INSITU_ROOT).parent_path() / "shared";
  if (!fs::is_directory(shared / "data/calibration")) return std::nullopt;
  return shared;
}

Json::Value FigueroaFigures(const fs::path& shared, const fs::path& work) {
  const fs::path folder = shared / "data/calibration/mrcal_figueroa_overpass";
  Json::Value json;
  json["opencv8"] = RmsOf(folder / "opencv8-0.cameramodel", work);
  json["splined"] = RmsOf(folder / "splined-0.cameramodel", work);
  return json;
}

Json::Value BoofcvFigures(const fs::path& shared, const fs::path& work) {
  const fs::path folder = shared / "data/calibration/boofcv_sony_hx5v_chess";
  const SitePaths site =
      BoardSite(folder, "frame", "interior_corners_x 4\ninterior_corners_y 6\nsquare_m 0.03\n",
                work / "boofcv");
  return AgainstTheirs(site, folder / "intrinsic.yaml", true);
}

Json::Value OpencvFigures(const fs::path& shared, const fs::path& work) {
  const fs::path folder = shared / "data/calibration/opencv_stereo_chessboard";
  const SitePaths site =
      BoardSite(folder, "left", "interior_corners_x 9\ninterior_corners_y 6\nsquare_m 0.025\n",
                work / "opencv");
  return AgainstTheirs(site, folder / "left_intrinsics.yml", false);
}

Json::Value MetricFigures(const fs::path& shared) {
  Json::Value json;
  json["dbat_largest_deviation_px"] =
      ReadCameraFile(shared / "data/calibration/dbat_camcal_c4040z/script/result/c4040z.xml")
          .largest_deviation_px;
  json["aicon_largest_deviation_px"] =
      ReadCameraFile(shared / "data/adjustment/jaicov_aicon/example.ior").largest_deviation_px;
  return json;
}

}  // namespace insitu
