// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/load_scene.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <future>
#include <memory>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "calibration/photo/tiled_image.h"
#include "radiometry/measure/photo_exposures.h"
#include "renderer/photo_gain.h"
#include "renderer/trace/make_montage_scene.h"
#include "renderer/trace/profile.h"
#include "renderer/trace/surface_textures.h"

namespace insitu {
namespace {

void RequireInputImage(const InputImage& image) {
  RequireResult(image.file, "insitu-undistort");
  RequirePhotographSize(image.file, image.camera.width(), image.camera.height());
}

// Whether all input images together are few enough to be held. Photographs that are rendered take
// memory beside them.
bool FitInMemory(const std::vector<InputImage>& images) {
  constexpr double kMostBytes = 0.8e9;
  double bytes = 0;
  for (const InputImage& image : images) {
    bytes += 3.0 * sizeof(float) * image.camera.width() * image.camera.height();
  }
  return bytes <= kMostBytes;
}

Raster ReadInUnit(const InputImage& image, const Eigen::Vector3d& gain) {
  Raster raster = ReadInputImage(image);
  if (gain != kUnitGain) DivideByGain(gain, &raster);
  return raster;
}

std::vector<Raster> ReadInputImages(const std::vector<InputImage>& images,
                                    const std::vector<Eigen::Vector3d>& gains) {
  std::vector<Raster> rasters(gains.size());
  tbb::parallel_for(size_t{0}, gains.size(),
                    [&](size_t i) { rasters[i] = ReadInUnit(images[i], gains[i]); });
  return rasters;
}

LocalImage::ImageFunction ReadWhenAsked(const InputImage& image, const Eigen::Vector3d& gain) {
  const std::shared_future<Raster> raster =
      std::async(std::launch::deferred, [image, gain] {
        // A thread that waits for its share takes up no other work, which might ask for the same.
        return tbb::this_task_arena::isolate([&] { return ReadInUnit(image, gain); });
      }).share();
  return [raster](const Eigen::Vector2d& pixel) { return Interpolate(raster.get(), pixel); };
}

std::vector<LocalImage::ImageFunction> TiledInputImages(const std::vector<InputImage>& images,
                                                        const std::vector<Eigen::Vector3d>& gains) {
  std::vector<LocalImage::ImageFunction> functions;
  for (size_t i = 0; i < gains.size(); ++i) {
    const TiledImage tiled(images[i].file, FactorOfGain(gains[i]));
    functions.emplace_back([tiled](const Eigen::Vector2d& pixel) { return tiled.At(pixel); });
  }
  return functions;
}

std::shared_ptr<const SurfaceTextures> LoadTextures(const SitePaths& site,
                                                    const NaturalEnvironment& natural,
                                                    const ArtificialEnvironment& building) {
  const auto has_texture = [](const SurfaceMaterial& material) {
    return !material.texture.empty() || !material.maps.empty();
  };
  if (std::ranges::none_of(building.materials, has_texture)) return nullptr;
  return std::make_shared<const SurfaceTextures>(building, site.building(),
                                                 site.root / "work/textures", PixelAngle(natural));
}

}  // namespace

Raster ReadInputImage(const InputImage& image) {
  RequireInputImage(image);
  return ReadPhotograph(image.file).linear;
}

std::future<SceneImages> ReadSceneImages(const std::vector<InputImage>& images,
                                         const std::vector<Eigen::Vector3d>& gains, bool is_quick) {
  return std::async(std::launch::async, [images, gains, is_quick]() -> SceneImages {
    const PhaseScope phase(Phase::kFiles);
    // One after the other: of several faults always the first is told.
    for (const InputImage& image : images) RequireInputImage(image);
    if (!FitInMemory(images)) return TiledInputImages(images, gains);
    if (!is_quick) return ReadInputImages(images, gains);
    std::vector<LocalImage::ImageFunction> functions;
    for (size_t i = 0; i < gains.size(); ++i) {
      functions.push_back(ReadWhenAsked(images[i], gains[i]));
    }
    return functions;
  });
}

MontageScene LoadScene(const SitePaths& site, NaturalEnvironment natural,
                       std::future<SceneImages> images, const ArtificialEnvironment& building) {
  const PhaseScope phase(Phase::kFiles);
  auto textures = LoadTextures(site, natural, building);
  const PhaseScope shading(Phase::kShading);
  MontageScene scene = SceneWithoutImages(std::move(natural), building);
  scene.textures = std::move(textures);
  SceneImages read_images = images.get();
  std::visit([&](auto& read) { SetInputImages(std::move(read), &scene); }, read_images);
  return scene;
}

}  // namespace insitu
