// SPDX-License-Identifier: GPL-3.0-or-later
// A picture to look at: upright, tile by tile and pixel by pixel, read when it is asked for.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "calibration/tiles/photo_pyramid.h"
#include "calibration/tiles/photo_tiles.h"
#include "calibration/tiles/pixel_value.h"
#include "calibration/web/web_request.h"

namespace insitu {

// Each from any thread; throws InputError: it cannot be read, or has no such tile or pixel.
class Picture {
 public:
  virtual ~Picture() = default;

  virtual PyramidSize Size() = 0;
  // JPEG of kTileSize squared, lossless PNG at level 0; beyond the picture its edge is repeated.
  virtual WebResponse Tile(int level, int x, int y) = 0;
  // {linear, encoded} of a pixel, and what else is to be known of it.
  virtual Json::Value Value(int x, int y) = 0;
  // Another one whenever its pixels may have changed.
  virtual std::string Version() = 0;
  virtual void Forget() {}  // what can be read again

 protected:
  void RequireTile(const std::string& name, int level, int x, int y);
  void RequirePixel(const std::string& name, int x, int y);
};

// How an image with EXIF's `orientation`, 1 to 8, stands upright.
cv::Mat UprightImage(const cv::Mat& image, int orientation);

// Where a pixel of a photograph as stored, of this size [px], is upright.
Eigen::Vector2d UprightPixel(const Eigen::Vector2d& stored, int width, int height, int orientation);

// The wanted cut of a level.
WebResponse TileResponse(const cv::Mat& level_image, const ColorSpace& color, int level, int x,
                         int y);

// The same of a picture of 8-bit codes, level 0 of it, that is not finished: where `is_done` of a
// pixel says no it is hatched.
WebResponse HatchedTile(const cv::Mat& shown, int level, int x, int y,
                        const std::function<bool(int x, int y)>& is_done);

Json::Value ValueJson(const PixelValue& value);

// Time and size of a file; "" where none is.
std::string FileVersion(const std::filesystem::path& file);

struct PictureFile {
  std::filesystem::path path;
  int orientation = 1;  // EXIF's, 1 to 8: how its rows are to be turned
};

// A photograph, an input image or a montage.
class FilePicture : public Picture {
 public:
  explicit FilePicture(PictureFile file) : file_(std::move(file)) {}
  PyramidSize Size() override;
  WebResponse Tile(int level, int x, int y) override;
  Json::Value Value(int x, int y) override;
  std::string Version() override { return FileVersion(file_.path); }
  void Forget() override;

  // Level 0, blue first, as the file has it but for its place; kept until Forget.
  cv::Mat Image(ColorSpace* color);

 private:
  struct Content {
    std::string version;
    std::shared_ptr<PhotoPyramid> pyramid;
    ColorSpace color;
  };
  Content Read();

  const PictureFile file_;
  std::mutex mutex_;
  Content content_;
};

}  // namespace insitu
