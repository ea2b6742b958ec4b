// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/site_photographs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>

#include "calibration/files/error.h"
#include "calibration/photo/tiled_image.h"
#include "calibration/program/program.h"
#include "calibration/site_cameras.h"

namespace insitu {

PhotographSet FindPhotographs(const SitePaths& site, const SceneGeometry& scene,
                              std::vector<ExifExposure>* exposures) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  std::vector<std::filesystem::path> files;
  for (const PosedCamera& posed : scene.cameras) {
    const auto path = std::find_if(paths.begin(), paths.end(),
                                   [&](const auto& p) { return p.stem() == posed.photo; });
    if (path == paths.end()) {
      throw InputError(site.photos(), "no photograph \"" + posed.photo +
                                          "\", expected every one that was reconstructed");
    }
    RequirePhotographSize(*path, posed.camera.width(), posed.camera.height());
    files.push_back(*path);
    exposures->push_back(ReadExifExposure(*path));
  }
  return PhotographSet(files);
}

std::vector<InputImage> ListInputImages(const SitePaths& site, const SceneGeometry& scene) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  const std::vector<std::string> cameras = CamerasOfPhotos(site, paths);
  std::map<std::string, std::string> camera_of_photo;
  for (size_t i = 0; i < paths.size(); ++i) camera_of_photo[paths[i].stem().string()] = cameras[i];
  std::vector<InputImage> images;
  for (const PosedCamera& posed : scene.cameras) {
    const std::filesystem::path pinhole = site.pinhole_camera(camera_of_photo.at(posed.photo));
    RequireResult(pinhole, "insitu-undistort");
    images.push_back({site.input_image(posed.photo), ReadCamera(pinhole)});
  }
  return images;
}

std::vector<LocalImage> LocalImages(const NaturalEnvironment& environment,
                                    const PhotographSet& photos,
                                    const std::vector<PhotoExposure>& exposures) {
  const SceneGeometry& scene = environment.scene;
  std::vector<LocalImage> images;
  for (size_t i = 0; i < photos.size(); ++i) {
    if (photos.IsAllHeld()) {
      images.emplace_back(scene.cameras[i], scene.origin,
                          [photo = photos[i]](const Eigen::Vector2d& pixel) {
                            return Interpolate(photo->linear, pixel);
                          });
      continue;
    }
    const InputImage& input = environment.input_images.at(i);
    RequireResult(input.file, "insitu-undistort");
    PosedCamera pinhole = scene.cameras[i];
    pinhole.camera = input.camera;
    const TiledImage tiled(input.file, FactorOfGain(exposures.at(i).gain));
    images.emplace_back(pinhole, scene.origin,
                        [tiled](const Eigen::Vector2d& pixel) { return tiled.At(pixel); });
  }
  return images;
}

}  // namespace insitu
