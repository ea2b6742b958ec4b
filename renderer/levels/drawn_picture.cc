// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/levels/drawn_picture.h"

#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

// Vermilion of Okabe and Ito, which all eyes tell from greens and greys. [Wong 2011]
const Eigen::Vector3d kDrawnCodes(0xD5 / 255.0, 0x5E / 255.0, 0x00 / 255.0);

}  // namespace

RenderResult DrawnOnto(const DrawnView& view, const Raster& shares) {
  const int width = view.photo.width, height = view.photo.height;
  RenderResult result;
  result.linear = view.photo;
  result.layers = Raster(width, height);
  result.unseen = Raster(width, height, 1);
  const Eigen::Vector3d color(LinearFromSrgb(kDrawnCodes[0]), LinearFromSrgb(kDrawnCodes[1]),
                              LinearFromSrgb(kDrawnCodes[2]));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float share = *shares.At(x, y);
      float* const layers = result.layers.At(x, y);
      layers[0] = 1 - share;
      layers[1] = share;
      if (share <= 0) continue;
      const Eigen::Vector3d photo = view.photo.Rgb(x, y);
      result.linear.SetRgb(x, y, photo + share * (color - photo));
      ++result.building_pixels;
    }
  }
  return result;
}

}  // namespace insitu
