// SPDX-License-Identifier: GPL-3.0-or-later
// A montage taken apart: images that add up to it again, and what they are of.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibration/photo/foreground.h"
#include "calibration/photo/raster.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/layers/light_errors.h"
#include "renderer/picture/render_options.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// What of a picture its layers are of, by the indices that LayeredPixel has.
struct LayerThings {
  std::vector<std::string> polygons, polygon_materials;  // of the site
  std::vector<std::string> materials;                    // of the building
  LightErrors errors = {};
};
LayerThings ThingsOf(const MontageScene& scene, const ArtificialEnvironment& building,
                     const LightErrors& errors);

class LayerImages {
 public:
  // `photo` as it is rendered into, in the site's unit; `foreground` may be null. Both must outlive
  // it. `chosen` by ChosenLayers: of others nothing is kept.
  LayerImages(const Raster& photo, const Foreground* foreground, LayerThings things,
              std::vector<std::string> chosen);
  ~LayerImages();
  LayerImages(const LayerImages&) = delete;
  LayerImages& operator=(const LayerImages&) = delete;

  // From any thread, each pixel once, those of a tile from one.
  void Take(int x, int y, const LayeredPixel& pixel);

  // All that was taken of a tile, for the day when its render goes on; from the thread that took
  // it.
  std::string TileBytes(int tile) const;
  // Instead of its pixels, by any thread. False, and nothing is taken: they are of another picture
  // or of other layers than those chosen.
  bool TakeTile(int tile, const std::string& bytes);

  // One EXR of many parts, 32-bit float, turned upright as montages are by EXIF's `orientation`.
  // `montage` is what was delivered: in each pixel and channel it is, bit for bit, the sum of the
  // parts that the header's "insituSum" names, added as 32-bit floats in that order.
  // `gain`: of the photograph over the site's unit. Throws std::runtime_error: it cannot be
  // written.
  void Write(const std::filesystem::path& file, const Raster& montage, const Eigen::Vector3d& gain,
             int orientation) const;

 private:
  struct TileLayers;

  bool IsChosen(const char* name) const;
  Raster Layer(int layer, const Raster& montage, const Eigen::Vector3f& gain) const;

  const Raster& photo_;
  const Foreground* const foreground_;
  const LayerThings things_;
  const std::vector<std::string> chosen_;
  const std::vector<float> object_ids_, material_ids_;
  std::vector<std::unique_ptr<TileLayers>> tiles_;     // null: the photograph stays in all of it
  Raster coverage_, distance_, normal_;                // empty: not chosen
  std::vector<Raster> object_ranks_, material_ranks_;  // (id, share), one channel each
  std::vector<Raster*> filled_;                        // those that are not empty
};

}  // namespace insitu
