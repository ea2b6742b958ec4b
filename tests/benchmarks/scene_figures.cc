// SPDX-License-Identifier: GPL-3.0-or-later
// Whole sites: photographs in, a report out.
#include <cmath>

#include "calibration/files/xml_file.h"
#include "calibration/site_calibration.h"
#include "reconstruction/geometry/resection.h"
#include "reconstruction/network/observation_costs.h"
#include "reconstruction/reconstruct_site.h"
#include "reconstruction/tie_points_site.h"
#include "tests/benchmarks/reconstruction_figures.h"

namespace insitu {
namespace {
namespace fs = std::filesystem;

constexpr double kChiSquare95Of2 = 5.991;

// A site in the folder for temporary files, new, with copies of these folders of `source`.
SitePaths NewSite(const std::string& name, const fs::path& source,
                  const std::vector<std::pair<std::string, std::string>>& folders) {
  const SitePaths site{fs::temp_directory_path() / ("insitu_figures_" + name)};
  fs::remove_all(site.root);
  for (const auto& [from, to] : folders) {
    fs::create_directories((site.root / to).parent_path());
    fs::copy(source / from, site.root / to, fs::copy_options::recursive);
  }
  return site;
}

Eigen::Vector3d Vector3Of(const XmlNode& node) {
  const std::vector<double> numbers = node.Numbers();
  if (numbers.size() != 3) throw node.Error("expected three numbers");
  return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

// ---- MicMac --------------------------------------------------------------------------------

// Its radial polynomial leads from the ideal pixel to the measured one (DistM2C, monde to camera).
struct MicmacLens {
  double focal_px = 0;
  Eigen::Vector2d principal_point, distortion_center;
  std::vector<double> coefficients;  // of r^2, r^4 ... [px]
};

MicmacLens ReadMicmacLens(const fs::path& path) {
  const XmlNode lens = XmlNode::Load(path).At("CalibrationInternConique");
  const XmlNode radial = lens.At("CalibDistortion").At("ModRad");
  const auto point = [](const XmlNode& node) {
    return Eigen::Vector2d(node.Numbers().at(0), node.Numbers().at(1));
  };
  MicmacLens result{lens.At("F").Number(), point(lens.At("PP")), point(radial.At("CDist")), {}};
  for (const XmlNode& k : radial.Children("CoeffDist")) result.coefficients.push_back(k.Number());
  return result;
}

// The fixed point of ideal = centre + (measured - centre) / factor(ideal).
Eigen::Vector2d IdealPixel(const MicmacLens& lens, const Eigen::Vector2d& measured) {
  const Eigen::Vector2d d = measured - lens.distortion_center;
  Eigen::Vector2d ideal = d;
  for (int iteration = 0; iteration < 50; ++iteration) {
    double power = 1, factor = 1;
    for (const double k : lens.coefficients) factor += k * (power *= ideal.squaredNorm());
    ideal = d / factor;
  }
  return lens.distortion_center + ideal;
}

// MicMac's matrix holds the camera's axes in its columns: world_from_cam.
Rigid3 ReadMicmacPose(const XmlNode& outer) {
  Eigen::Matrix3d world_from_cam;
  const XmlNode rows = outer.At("ParamRotation").At("CodageMatr");
  for (int row = 0; row < 3; ++row) {
    world_from_cam.row(row) = Vector3Of(rows.At("L" + std::to_string(row + 1)));
  }
  const Eigen::Quaterniond rotation(world_from_cam.transpose().eval());
  return {rotation, -(rotation * Vector3Of(outer.At("Centre")))};
}

void AddPhoto(const MicmacLens& lens, const XmlNode& orientation, Json::Value* json) {
  std::vector<ResectionPoint> points;
  for (const XmlNode& pair : orientation.At("Verif").Children("Appuis")) {
    const std::vector<double> pixel = pair.At("Im").Numbers();
    points.push_back({Vector3Of(pair.At("Ter")), IdealPixel(lens, {pixel.at(0), pixel.at(1)})});
  }
  const Camera camera = Camera::Pinhole(lens.focal_px, lens.focal_px, lens.principal_point.x(),
                                        lens.principal_point.y(), 1728, 1152);
  const auto ours = Resect(camera, points);
  if (!ours) throw orientation.Error("cannot be resected");
  const Rigid3 theirs = ReadMicmacPose(orientation.At("Externe"));
  Json::Value photo;
  photo["pairs"] = static_cast<int>(points.size());
  photo["rms_px"] = ours->rms_px;
  photo["center_difference_m"] = (Center(ours->cam_from_world) - Center(theirs)).norm();
  photo["rotation_difference_rad"] = ours->cam_from_world.rotation.angularDistance(theirs.rotation);
  json->append(photo);
}

// ---- gallery -------------------------------------------------------------------------------

// Squared Mahalanobis distance of a direction's error within its tangent plane.
double SquaredDistance(const Eigen::Vector3d& unit, const Eigen::Matrix3d& covariance,
                       const Eigen::Vector3d& truth) {
  const Eigen::Matrix<double, 2, 3> axes = AxesAcross(unit);
  const Eigen::Vector2d error = axes * truth.normalized();
  return error.dot((axes * covariance * axes.transpose()).inverse() * error);
}

}  // namespace

Json::Value StonewallFigures(const fs::path& data) {
  const fs::path folder = data / "scenes/micmac_stonewall_gcp/Ori-Ground_mm3d";
  const MicmacLens lens = ReadMicmacLens(folder / "AutoCal_Foc-28000_Cam-PENTAX_K5.xml");
  Json::Value json;
  for (const char* name : {"IMGP4167", "IMGP4168", "IMGP4169", "IMGP4170"}) {
    const XmlNode root = XmlNode::Load(folder / ("Orientation-" + std::string(name) + ".JPG.xml"));
    AddPhoto(lens, root.At("OrientationConique"), &json["photos"]);
  }
  return json;
}

Json::Value BerlinFigures(const fs::path& data) {
  const SitePaths site =
      NewSite("berlin", data / "scenes/opensfm_berlin_cathedral", {{"images", "photos"}});
  CalibrateSite(site);
  const SiteTiePoints matched = MakeTiePoints(site);
  AdjustmentOptions options;
  options.is_self_calibrating = true;  // EXIF's focal length is no calibration
  const Adjustment adjustment = ReconstructSite(site, options);
  Json::Value json;
  json["photos"] = 3;
  json["placed"] = static_cast<int>(matched.tie_points.cam_from_model.size());
  json["tie_points"] = static_cast<int>(matched.tie_points.points.size());
  json["sigma0"] = adjustment.sigma0;
  json["datum_defect"] = adjustment.datum_defect;
  json["has_report"] = fs::exists(site.residual_report()) && fs::exists(site.residual_page());
  return json;
}

Json::Value GalleryFigures(const fs::path& data) {
  const SitePaths site =
      NewSite("gallery", data / "gallery",
              {{"photos", "photos"}, {"calibration", "calibration"}, {"survey", "survey"}});
  CalibrateSite(site);
  const Adjustment adjustment = ReconstructSite(site);
  const SceneGeometry& scene = adjustment.scene;
  Json::Value json;
  json["sigma0"] = adjustment.sigma0;
  json["check_rms_over_sigma"] = adjustment.check_rms_over_sigma;
  json["check_points"] = static_cast<int>(adjustment.check.size());
  json["chi_square_95"] = kChiSquare95Of2;
  json["sun_chi_square"] =
      SquaredDistance(scene.sun->unit, scene.sun->covariance, {0.793943, 0.142317, 0.591101});
  json["zenith_chi_square"] =
      SquaredDistance(scene.zenith.unit, scene.zenith.covariance, {0.004887, -0.003665, 0.999981});
  return json;
}

}  // namespace insitu
