// SPDX-License-Identifier: GPL-3.0-or-later
// Surveys of MicMac and OpenSfM, read and held against what those programs made of them.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "calibration/files/xml_file.h"
#include "calibration/photo/photograph.h"
#include "reconstruction/exchange/import_survey.h"
#include "reconstruction/exchange/read_survey_file.h"
#include "reconstruction/geometry/resection.h"
#include "tests/shared_data.h"

namespace insitu {
namespace {

Eigen::Vector3d Vector3(const XmlNode& node) { return Eigen::Vector3d(node.Numbers().data()); }
Eigen::Vector2d Vector2(const XmlNode& node) { return Eigen::Vector2d(node.Numbers().data()); }

// MicMac's calibration of the old kind: a pinhole, whose pixels its distortion ("DistM2C") moves
// away from a centre by c1 r^3 + c2 r^5 + c3 r^7 + c4 r^9.
struct MicMacCamera {
  Camera pinhole;
  Eigen::Vector2d center;
  std::vector<double> coefficients;

  // What the pinhole shows where a photo shows `pixel`: the distortion undone by iteration.
  Eigen::Vector2d Corrected(const Eigen::Vector2d& pixel) const {
    Eigen::Vector2d offset = pixel - center;
    for (int i = 0; i < 100; ++i) offset = (pixel - center) / (1 + Radial(offset.squaredNorm()));
    return center + offset;
  }
  double Radial(double r2) const {
    double radial = 0;
    for (size_t i = coefficients.size(); i-- > 0;) radial = r2 * (coefficients[i] + radial);
    return radial;
  }
};

MicMacCamera ReadMicMacCamera(const std::filesystem::path& path) {
  const XmlNode calibration = XmlNode::Load(path).At("CalibrationInternConique");
  const XmlNode radial = calibration.At("CalibDistortion").At("ModRad");
  const Eigen::Vector2d principal = Vector2(calibration.At("PP"));
  const double focal = calibration.At("F").Number();
  MicMacCamera camera{Camera::Pinhole(focal, focal, principal.x(), principal.y(), 1728, 1152),
                      Vector2(radial.At("CDist")),
                      {}};
  for (const XmlNode& coefficient : radial.Children("CoeffDist")) {
    camera.coefficients.push_back(coefficient.Number());
  }
  return camera;
}

struct MicMacOrientation {
  Rigid3 cam_from_world;
  std::vector<ResectionPoint> pairs;  // the ten that it wrote to check readers by; corrected pixels
};

MicMacOrientation ReadMicMacOrientation(const std::filesystem::path& path,
                                        const MicMacCamera& camera) {
  const XmlNode orientation = XmlNode::Load(path).At("OrientationConique");
  const XmlNode exterior = orientation.At("Externe");
  const XmlNode rows = exterior.At("ParamRotation").At("CodageMatr");
  Eigen::Matrix3d world_from_cam;
  world_from_cam << Vector3(rows.At("L1")).transpose(), Vector3(rows.At("L2")).transpose(),
      Vector3(rows.At("L3")).transpose();
  MicMacOrientation result;
  result.cam_from_world.rotation =
      Eigen::Quaterniond(Eigen::Matrix3d(world_from_cam.transpose())).normalized();
  result.cam_from_world.translation =
      -(result.cam_from_world.rotation * Vector3(exterior.At("Centre")));
  for (const XmlNode& pair : orientation.At("Verif").Children("Appuis")) {
    result.pairs.push_back({Vector3(pair.At("Ter")), camera.Corrected(Vector2(pair.At("Im")))});
  }
  return result;
}

double RmsPx(const Camera& camera, const Rigid3& cam_from_world,
             const std::vector<ResectionPoint>& points) {
  double sum = 0;
  for (const ResectionPoint& point : points) {
    sum += (*camera.Project(cam_from_world * point.world) - point.pixel).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

class Stonewall : public testing::Test {
 protected:
  static constexpr const char* kData = "scenes/micmac_stonewall_gcp";
  static std::filesystem::path OrientationOf(const std::filesystem::path& folder,
                                             const std::string& photo) {
    return folder / ("Ori-Ground_mm3d/Orientation-" + photo + ".JPG.xml");
  }
  static MicMacCamera CameraOf(const std::filesystem::path& folder) {
    return ReadMicMacCamera(folder / "Ori-Ground_mm3d/AutoCal_Foc-28000_Cam-PENTAX_K5.xml");
  }
};

TEST_F(Stonewall, ResectionReproducesTheTenPairsOfEachPhoto) {
  INSITU_SHARED_DATA_OR_SKIP(folder, kData);
  const MicMacCamera camera = CameraOf(folder);
  for (const char* photo : {"IMGP4167", "IMGP4168", "IMGP4169", "IMGP4170"}) {
    const MicMacOrientation micmac = ReadMicMacOrientation(OrientationOf(folder, photo), camera);
    ASSERT_EQ(micmac.pairs.size(), 10u);
    const auto ours = Resect(camera.pinhole, micmac.pairs);
    ASSERT_TRUE(ours);
    const double apart = (Center(ours->cam_from_world) - Center(micmac.cam_from_world)).norm();
    std::printf("%s: ten pairs, RMS %.2e px (MicMac's own pose %.2e px), centres %.2e m apart\n",
                photo, ours->rms_px, RmsPx(camera.pinhole, micmac.cam_from_world, micmac.pairs),
                apart);
    EXPECT_LT(ours->rms_px, 1e-3);
    EXPECT_LT(apart, 1e-5);
  }
}

TEST_F(Stonewall, BothKindsOfItsFilesAreTheSameSurvey) {
  INSITU_SHARED_DATA_OR_SKIP(folder, kData);
  const std::filesystem::path mmvii = folder / "MMVII-PhgrProj/PointsMeasure/Saisies_MMVII";
  const std::set<std::string> photos = {"IMGP4167", "IMGP4168", "IMGP4169", "IMGP4170"};
  const PhotoSize size = [](const std::string&) { return Eigen::Vector2i(1728, 1152); };
  SurveyImportOptions options;
  options.sigma_m = 0.01;
  options.mark_sigma_px = 1;
  const SurveyImport old_kind = ImportSurvey(
      {folder / "Ground-Pts3D.xml", folder / "GroundMeasure.xml"}, photos, size, options);
  std::vector<std::filesystem::path> files = {mmvii / "MesGCP-FromV1-Ground-Pts3D.xml"};
  for (const std::string& photo : photos) files.push_back(mmvii / ("MesIm-" + photo + ".JPG.xml"));
  const SurveyImport new_kind = ImportSurvey(files, photos, size, options);
  EXPECT_EQ(old_kind.control_points.size(), 9u);
  EXPECT_EQ(new_kind.control_points.size(), 9u);
  ASSERT_EQ(old_kind.observations.size(), new_kind.observations.size());
  EXPECT_EQ(old_kind.observations.size(), 16u);
  std::map<std::pair<std::string, std::string>, Eigen::Vector2d> pixels;
  for (const auto& mark : old_kind.observations) pixels[{mark.photo, mark.point}] = mark.pixel;
  for (const auto& mark : new_kind.observations) {
    EXPECT_LT((pixels.at({mark.photo, mark.point}) - mark.pixel).norm(), 1e-9);
  }
}

TEST_F(Stonewall, ResectionFromItsControlFitsAsWellAsMicMac) {
  INSITU_SHARED_DATA_OR_SKIP(folder, kData);
  const PhotoSize size = [](const std::string&) { return Eigen::Vector2i(1728, 1152); };
  const MicMacCamera camera = CameraOf(folder);
  std::map<std::string, Eigen::Vector3d> places;
  for (const auto& point : ReadSurveyFile(folder / "Ground-Pts3D.xml", size).points) {
    places[point.name] = point.position;
  }
  std::map<std::string, std::vector<ResectionPoint>> points;
  for (const auto& mark : ReadSurveyFile(folder / "GroundMeasure.xml", size).marks) {
    const auto place = places.find(mark.point);
    if (place == places.end()) continue;
    points[mark.photo].push_back({place->second, camera.Corrected(mark.pixel)});
  }
  ASSERT_EQ(points.size(), 4u);
  for (const auto& [photo, marks] : points) {
    const MicMacOrientation micmac = ReadMicMacOrientation(OrientationOf(folder, photo), camera);
    const double theirs = RmsPx(camera.pinhole, micmac.cam_from_world, marks);
    std::optional<Rigid3> guess;  // three points fit several poses: the one near MicMac's
    if (marks.size() == 3) guess = micmac.cam_from_world;
    const auto ours = Resect(camera.pinhole, marks, guess);
    ASSERT_TRUE(ours) << photo;
    const double apart = (Center(ours->cam_from_world) - Center(micmac.cam_from_world)).norm();
    std::printf(
        "%s: %zu control points, RMS %.3f px, MicMac's pose %.3f px, centres %.4f m apart\n",
        photo.c_str(), marks.size(), ours->rms_px, theirs, apart);
    EXPECT_LE(ours->rms_px, theirs + 1e-9);
    EXPECT_LT(apart, 0.1);
  }
}

TEST(BerlinCathedral, ControlOfOpenSfmIsRead) {
  INSITU_SHARED_DATA_OR_SKIP(folder, "scenes/opensfm_berlin_cathedral");
  const std::set<std::string> photos = {"01", "02", "03"};
  const PhotoSize size = [&](const std::string& photo) -> std::optional<Eigen::Vector2i> {
    return ReadPhotographSize(folder / "images" / (photo + ".jpg"));
  };
  SurveyImportOptions options;
  options.sigma_m = 1;
  options.mark_sigma_px = 2;
  const SurveyImport import =
      ImportSurvey({folder / "ground_control_points.json"}, photos, size, options);
  for (const std::string& line : import.report) std::printf("%s\n", line.c_str());
  ASSERT_EQ(import.control_points.size(), 2u);
  ASSERT_EQ(import.observations.size(), 3u);
  // Berlin's cathedral is about E 391.4 km, N 5820.0 km in zone 33.
  EXPECT_NEAR(import.control_points[0].position.x(), 391400, 300);
  EXPECT_NEAR(import.control_points[0].position.y(), 5820000, 500);
  EXPECT_NEAR(import.observations[0].pixel.x(), 1631.5 - 0.015689 * 3264, 1e-9);
}

}  // namespace
}  // namespace insitu
