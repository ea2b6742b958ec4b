// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/renderer/trace/small_site.h"

#include <numbers>

#include "renderer/trace/make_montage_scene.h"

namespace insitu {
namespace {

Polygon Lawn(const Eigen::Vector3d& origin) {
  Polygon lawn;
  lawn.name = "lawn";
  for (const auto& [x, y] : {std::pair(-100, -100), {100, -100}, {100, 100}, {-100, 100}}) {
    lawn.vertices.push_back(origin + Eigen::Vector3d(x, y, 0));
  }
  lawn.normal = Eigen::Vector3d::UnitZ();
  lawn.photo = 0;
  lawn.material = "lawn";
  return lawn;
}

PosedCamera LookNorth(const Camera& camera, const Eigen::Vector3d& origin) {
  // Rows: right = east, down, forward = north.
  Eigen::Matrix3d level;
  level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::AngleAxisd down(0.2, Eigen::Vector3d::UnitX());
  Rigid3 cam_from_world;
  cam_from_world.rotation = Eigen::Quaterniond(down * level);
  cam_from_world.translation = -(cam_from_world.rotation * (origin + Eigen::Vector3d(0, -10, 3)));
  return {"photo", camera, cam_from_world};
}

void AddTriangle(ArtificialEnvironment& building, const Eigen::Vector3i& corners) {
  building.triangles.push_back(corners);
  building.material_of_triangle.push_back(0);
}

}  // namespace

MontageScene SmallSite::With(const ArtificialEnvironment& building) const {
  return MakeMontageScene(natural, building, {photo});
}

SmallSite MakeSmallSite(int bins) {
  SmallSite site;
  site.natural.spectra = SpectralBasis(Rec709(), {bins});
  SceneGeometry& scene = site.natural.scene;
  scene.origin = {2600000, 1200000, 400};
  scene.polygons = {Lawn(scene.origin)};
  scene.cameras = {LookNorth(site.pinhole, scene.origin)};
  site.natural.input_images = {{"photo.exr", site.pinhole}};
  scene.zenith.unit = Eigen::Vector3d::UnitZ();
  site.natural.materials["lawn"] = {};
  Daylight& light = site.natural.light;
  light.sun_direction = Eigen::Vector3d(1, 0, 1).normalized();
  const Spectrum white = site.natural.spectra.SpectrumFromRgb(Eigen::Vector3d::Ones());
  light.sun_radiance = 2.0 / light.sun_solid_angle * white;  // E_s = 2 facing the sun
  light.sky_radiance = 0.3 * white;
  light.ambient_radiance = 0.05 * white;
  site.natural.air.horizon = 0.5 * white;
  site.photo = Raster(64, 48);
  site.photo.data.assign(site.photo.data.size(), static_cast<float>(kLawnRadiance));
  return site;
}

ArtificialEnvironment Plate(const SmallSite& site, const Eigen::Vector3d& center, double half,
                            const SurfaceMaterial& material) {
  ArtificialEnvironment plate;
  plate.materials = {material};
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    plate.vertices.push_back(site.natural.scene.origin + center + half * Eigen::Vector3d(x, y, 0));
  }
  AddTriangle(plate, {0, 1, 2});
  AddTriangle(plate, {0, 2, 3});
  return plate;
}

ArtificialEnvironment Box(const SmallSite& site, const Eigen::Vector3d& low,
                          const Eigen::Vector3d& high, const SurfaceMaterial& material) {
  ArtificialEnvironment box;
  box.materials = {material};
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                                 i & 4 ? high.z() : low.z());
    box.vertices.push_back(site.natural.scene.origin + corner);
  }
  const Eigen::Vector4i faces[] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const Eigen::Vector4i& face : faces) {
    AddTriangle(box, {face[0], face[1], face[2]});
    AddTriangle(box, {face[0], face[2], face[3]});
  }
  return box;
}

}  // namespace insitu
