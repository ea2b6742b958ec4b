// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/radiometry/transport/court.h"

#include <numbers>

namespace insitu {
namespace {

constexpr int kSide = 256;         // [px]
constexpr double kFocal = 120;     // [px]: 94 degrees
constexpr double kSkyPixel = 0.9;  // of the photographs; no surface takes it
const Eigen::Vector3d kOrigin(2600000, 1200000, 400);

PosedCamera Look(const Eigen::Vector3d& from, const Eigen::Vector3d& forward) {
  const Eigen::Vector3d right = forward.unitOrthogonal();
  Eigen::Matrix3d cam_from_world;
  cam_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  const Eigen::Quaterniond rotation(cam_from_world);
  const double middle = (kSide - 1) / 2.0;
  return {"photo",
          Camera::Pinhole(kFocal, kFocal, middle, middle, kSide, kSide),
          {rotation, -(rotation * (kOrigin + from))}};
}

}  // namespace

void Court::AddWall(const std::string& name, const Eigen::Vector3d& corner,
                    const Eigen::Vector3d& u, const Eigen::Vector3d& v, double radiance) {
  const Eigen::Vector3d a = kOrigin + corner;
  scene_.polygons.push_back(
      {name, {a, a + u, a + u + v, a + v}, u.cross(v).normalized(), std::nullopt, name});
  radiance_of_polygon_.push_back(radiance);
}

void Court::AddOpenBox(double half, double height, double radiance) {
  const Eigen::Vector3d x(2 * half, 0, 0), y(0, 2 * half, 0), z(0, 0, height);
  AddWall("ground", {-half, -half, 0}, x, y, radiance);
  AddWall("south", {-half, -half, 0}, z, x, radiance);
  AddWall("north", {-half, half, 0}, x, z, radiance);
  AddWall("west", {-half, -half, 0}, y, z, radiance);
  AddWall("east", {half, -half, 0}, z, y, radiance);
}

void Court::AddPlanned(const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                       const Eigen::Vector3d& v, double albedo) {
  const int first = static_cast<int>(planned_.mesh.vertices.size());
  for (const Eigen::Vector3d& vertex :
       {corner, Eigen::Vector3d(corner + u), Eigen::Vector3d(corner + u + v),
        Eigen::Vector3d(corner + v)}) {
    planned_.mesh.vertices.push_back(vertex.cast<float>());
  }
  for (const Eigen::Vector3i& triangle : {Eigen::Vector3i(0, 1, 2), Eigen::Vector3i(0, 2, 3)}) {
    planned_.mesh.triangles.push_back(triangle + Eigen::Vector3i::Constant(first));
    planned_.normals.push_back(u.cross(v).normalized());
    planned_.materials.push_back(static_cast<int>(planned_.brdfs.size()));
  }
  planned_.brdfs.push_back(Spectrum::Constant(albedo / std::numbers::pi));
}

void Court::AddPlannedBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double albedo) {
  const Eigen::Vector3d size = high - low;
  const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  AddPlanned(low, y, x, albedo);
  AddPlanned(low, x, z, albedo);
  AddPlanned(low, z, y, albedo);
  AddPlanned(high, -x, -y, albedo);
  AddPlanned(high, -z, -x, albedo);
  AddPlanned(high, -y, -z, albedo);
}

void Court::Photograph(const Eigen::Vector3d& from) {
  scene_.origin = kOrigin;
  scene_.zenith.unit = Eigen::Vector3d::UnitZ();
  polygons_ = MeshOfPolygons(scene_);
  rays_ = std::make_unique<RayScene>(polygons_.mesh);
  planned_rays_ = std::make_unique<RayScene>(planned_.mesh);
  for (int axis = 0; axis < 3; ++axis) {
    scene_.cameras.push_back(Look(from, Eigen::Vector3d::Unit(axis)));
    scene_.cameras.push_back(Look(from, -Eigen::Vector3d::Unit(axis)));
  }
  for (const PosedCamera& posed : scene_.cameras) {
    Raster& photo = photos_.emplace_back(kSide, kSide);
    const Eigen::Quaterniond world_from_cam = posed.cam_from_world.rotation.conjugate();
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double middle = (kSide - 1) / 2.0;
        const Eigen::Vector3d sight(x - middle, y - middle, kFocal);
        const auto hit = rays_->Nearest({from, (world_from_cam * sight).normalized()});
        const double radiance =
            hit ? radiance_of_polygon_[polygons_.polygon_of_triangle[hit->triangle]] : kSkyPixel;
        photo.SetRgb(x, y, Eigen::Vector3d::Constant(radiance));
      }
    }
  }
  for (size_t i = 0; i < photos_.size(); ++i) {
    images_.emplace_back(scene_.cameras[i], scene_.origin, photos_[i]);
  }
}

Daylight Court::UnderSky(double radiance) const {
  Daylight light;
  light.sky_radiance = Grey(radiance);
  return light;
}

TransportScene Court::Scene(std::function<Spectrum(const SurfacePoint&)> lamps) const {
  return {{scene_, *rays_, polygons_.polygon_of_triangle, images_, air_, spectra_},
          polygons_.mesh,
          {planned_.mesh, *planned_rays_, planned_.normals, planned_.materials, planned_.brdfs},
          std::move(lamps)};
}

}  // namespace insitu
