// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/radiometry/measure/synthetic_site.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWallY = 10;      // [m]
constexpr double kWallHeight = 6;  // [m]
const Eigen::Vector3d kOrigin(2600500, 1200300, 430);
const Eigen::Vector3d kSun = Eigen::Vector3d(0.3, 0.8, 0.52).normalized();  // behind the wall

struct Spot {
  std::string photo, polygon;
  Eigen::Vector3d local;  // [m], about the origin
};

std::vector<Spot> DaylightSpots() {
  return {{"A", "ground", {-3, -8, 0}}, {"A", "ground", {0, -4, 0}}, {"A", "ground", {3, -1, 0}},
          {"A", "ground", {-4, 3, 0}},  {"A", "ground", {0, 6, 0}},  {"A", "ground", {4, 8.5, 0}},
          {"A", "ground", {6, -9, 0}},  // below the path
          {"A", "wall", {-5, 10, 2}},   {"A", "wall", {5, 10, 4}}};
}

std::vector<Spot> HazeSpots() {
  std::vector<Spot> spots;
  for (const double y : {-170.0, -160.0, -145.0, -120.0, -90.0, -60.0}) {
    spots.push_back({"B", "ground", {(y + 100) / 10, y, 0}});
  }
  return spots;
}

PosedCamera CameraAt(const std::string& photo, const Eigen::Vector3d& local) {
  Eigen::Matrix3d cam_from_world;  // x to the right, y down, z along the world's y
  cam_from_world << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Quaterniond rotation(cam_from_world);
  return {photo,
          Camera::Pinhole(800, 800, 449.5, 299.5, 900, 600),
          {rotation, -(rotation * (kOrigin + local))}};
}

Polygon MakePolygon(const std::string& name, const std::string& material,
                    const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                    const Eigen::Vector3d& v) {
  const Eigen::Vector3d a = kOrigin + corner;
  return {name, {a, a + u, a + u + v, a + v}, u.cross(v).normalized(), 0, material};
}

SceneGeometry MakeScene() {
  SceneGeometry scene;
  scene.origin = kOrigin;
  scene.cameras = {CameraAt("A", {0, -25, 5}), CameraAt("B", {0, -190, 5})};
  scene.polygons = {
      MakePolygon("ground", "concrete", {-300, -300, 0}, {600, 0, 0}, {0, 600, 0}),
      MakePolygon("wall", "concrete", {-300, kWallY, 0}, {600, 0, 0}, {0, 0, kWallHeight}),
      MakePolygon("path", "gravel", {5, -20, 0.01}, {2, 0, 0}, {0, 29, 0})};
  scene.polygons[1].photo.reset();
  scene.sun = Direction{kSun, Eigen::Matrix3d::Identity() * 1e-7};
  scene.zenith = {Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Identity() * 1e-8};
  scene.vertex_sigma = 0.004;
  return scene;
}

Eigen::Array3d Irradiance(const SyntheticSite& truth, const Spot& spot) {
  const Eigen::Array3d ambient = kPi * truth.ambient_radiance.array();
  const Eigen::Array3d sky = kPi * truth.sky_radiance.array();
  if (spot.polygon == "wall") return ambient + sky / 2;  // and the sun stands behind it
  const double to_wall = kWallY - spot.local.y();
  const double elevation = std::atan(kWallHeight / to_wall);
  const bool lit = to_wall * kSun.z() > kWallHeight * kSun.y();
  return ambient + sky * (1 + std::cos(elevation)) / 2 +
         (lit ? kSun.z() : 0) * truth.sun_irradiance.array();
}

Eigen::Vector3d ApparentRgb(const SyntheticSite& truth, const Spot& spot, double distance) {
  const Eigen::Array3d true_color = truth.reflectance / kPi * Irradiance(truth, spot);
  const Eigen::Array3d tau = truth.transmittance.array().pow(distance);
  return true_color * tau + truth.horizon.array() * (1 - tau);
}

const PosedCamera& CameraOf(const SyntheticSite& truth, const std::string& photo) {
  return truth.scene.cameras[photo == "A" ? 0 : 1];
}

Eigen::Vector2d PixelOf(const SyntheticSite& truth, const std::string& photo,
                        const Eigen::Vector3d& local) {
  const PosedCamera& posed = CameraOf(truth, photo);
  const auto pixel = posed.camera.Project(posed.cam_from_world * (kOrigin + local));
  INSITU_CHECK(pixel && posed.camera.Sees(*pixel));
  return *pixel;
}

// Sky everywhere, with a patch of the right colour about each spot.
Raster PaintPhoto(const SyntheticSite& truth, const std::string& photo,
                  const std::vector<Spot>& spots) {
  Raster image(900, 600);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) image.SetRgb(x, y, truth.horizon);
  }
  const Eigen::Vector3d center = Center(CameraOf(truth, photo).cam_from_world);
  for (const Spot& spot : spots) {
    if (spot.photo != photo) continue;
    const Eigen::Vector2i at = PixelOf(truth, photo, spot.local).array().round().cast<int>();
    const double distance = (kOrigin + spot.local - center).norm();
    for (int y = at.y() - 3; y <= at.y() + 3; ++y) {
      for (int x = at.x() - 3; x <= at.x() + 3; ++x) {
        image.SetRgb(x, y, ApparentRgb(truth, spot, distance));
      }
    }
  }
  return image;
}

std::string Entries(const SyntheticSite& truth, const std::vector<Spot>& spots) {
  std::string text;
  for (const Spot& spot : spots) {
    text += (text.empty() ? "\n  " : ",\n  ") +
            SampleEntry(truth, spot.photo, spot.polygon, spot.local);
  }
  return text;
}

}  // namespace

std::string SampleEntry(const SyntheticSite& synthetic, const std::string& photo,
                        const std::string& polygon, const Eigen::Vector3d& local) {
  const Eigen::Vector2d pixel = PixelOf(synthetic, photo, local);
  std::ostringstream out;
  out.precision(17);
  out << "{\"photo\": \"" << photo << "\", \"x\": " << pixel.x() << ", \"y\": " << pixel.y()
      << ", \"polygon\": \"" << polygon << "\"}";
  return out.str();
}

SyntheticSite MakeSyntheticSite(const std::string& name) {
  SyntheticSite truth;
  truth.site.root = std::filesystem::path(testing::TempDir()) / "insitu_radiometry" / name;
  std::filesystem::remove_all(truth.site.root);
  truth.scene = MakeScene();
  WriteSceneGeometry(truth.site, truth.scene);
  std::vector<Spot> spots = DaylightSpots();
  for (const Spot& spot : HazeSpots()) spots.push_back(spot);
  for (const char* photo : {"A", "B"}) {
    WriteExr(truth.site.photos() / (std::string(photo) + ".exr"), PaintPhoto(truth, photo, spots));
  }
  WritePosedCamera(truth.site.pinhole_camera(), truth.scene.cameras[0], "as the photographs");
  WriteWhole(truth.site.survey() / "samples.json",
             "{\n\"horizon\": [{\"photo\": \"A\", \"x\": 450, \"y\": 20}],\n\"haze\": [" +
                 Entries(truth, HazeSpots()) + "],\n\"daylight\": [" +
                 Entries(truth, DaylightSpots()) +
                 "],\n\"daylight_reflectance_rgb\": [0.4, 0.4, 0.4]\n}\n");
  return truth;
}

}  // namespace insitu
