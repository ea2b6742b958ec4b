// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph with all that rendering into it needs.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/photo/foreground.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/site.h"
#include "radiometry/natural_environment.h"
#include "renderer/photo_gain.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

enum class Frame {
  kPhoto,
  kPinhole
};  // the original photograph's pixel grid, or the input image's

struct RenderView {
  PosedCamera camera;
  ImageQuality quality;  // in the site's unit
  Photograph photo;
  Eigen::Vector3d gain = kUnitGain;
  Raster relit = {};    // the photograph at the site's hour; empty where that is its own
  Raster in_unit = {};  // the one that is shown, over its gain; empty where that is the photograph
  std::shared_ptr<const Foreground> foreground = {};  // null: nothing stands in front
  std::optional<Raster> drawn_shadows = {};           // one channel, as SunShares::share
};

// Where the environment has a photograph. Throws InputError: nowhere.
size_t CameraIndex(const SitePaths& site, const SceneGeometry& scene, const std::string& photo);

// The photograph in the site's unit, in which the scene's light is measured.
const Raster& InUnit(const RenderView& view);

// Has photographs not asked for the colour of polygons where their masks say that something stands
// before them. Throws InputError: a mask that is missing or of another size.
void HeedMasks(const SitePaths& site, MontageScene* scene);

// What stands in front is what the matte says, and, where the photograph shows polygons and not the
// building, what their masks do. `gains`: of the scene's cameras. Throws InputError: a photograph,
// matte, mask or drawing of shadows whose size is not the camera's.
RenderView LoadView(const SitePaths& site, const MontageScene& scene,
                    const std::vector<Eigen::Vector3d>& gains,
                    const std::filesystem::path& photograph, Frame frame);

}  // namespace insitu
