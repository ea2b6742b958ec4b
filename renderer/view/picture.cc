// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/picture.h"

#include <sys/stat.h>

#include <opencv2/imgproc.hpp>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/tiles/shown_image.h"

namespace insitu {
namespace {

// EXIF's orientations: from 5 on rows become columns; then these are mirrored.
bool IsAcross(int orientation) { return orientation >= 5; }
bool IsMirroredAlongRows(int orientation) {
  return orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
}
bool IsMirroredAlongColumns(int orientation) {
  return orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
}

constexpr int kHatchPeriod = 12, kHatchWidth = 4;  // [px] on the screen
constexpr double kHatchOpacity = 0.65;
const cv::Vec3b kHatchColor(0, 159, 230);  // #e69f00

// Stripes across what is not done of a tile.
void Hatch(int level, int x, int y, const cv::Size& size,
           const std::function<bool(int x, int y)>& is_done, cv::Mat* cut) {
  for (int v = 0; v < cut->rows; ++v) {
    for (int u = 0; u < cut->cols; ++u) {
      const int across = x * kTileSize + u, down = y * kTileSize + v;
      const int64_t left = int64_t{across} << level, top = int64_t{down} << level;
      if (left >= size.width || top >= size.height) continue;
      if ((across + down) % kHatchPeriod >= kHatchWidth) continue;
      if (is_done(static_cast<int>(left), static_cast<int>(top))) continue;
      auto& pixel = cut->at<cv::Vec3b>(v, u);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = cv::saturate_cast<uchar>(kHatchOpacity * kHatchColor[c] +
                                            (1 - kHatchOpacity) * pixel[c]);
      }
    }
  }
}

int TilesOf(int size, int level) {
  const int64_t level_size = (int64_t{size} + (int64_t{1} << level) - 1) >> level;
  return static_cast<int>((level_size + kTileSize - 1) / kTileSize);
}

}  // namespace

void Picture::RequireTile(const std::string& name, int level, int x, int y) {
  const PyramidSize size = Size();
  if (level >= 0 && level < size.levels && x >= 0 && y >= 0 && x < TilesOf(size.width, level) &&
      y < TilesOf(size.height, level)) {
    return;
  }
  throw InputError(name, "has no tile (" + std::to_string(x) + ", " + std::to_string(y) +
                             ") of level " + std::to_string(level));
}

void Picture::RequirePixel(const std::string& name, int x, int y) {
  const PyramidSize size = Size();
  if (x >= 0 && y >= 0 && x < size.width && y < size.height) return;
  throw InputError(name, "has no pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                             "), it is " + SizeText(size.width, size.height));
}

cv::Mat UprightImage(const cv::Mat& image, int orientation) {
  if (orientation == 1) return image;
  // Into new memory each: the image's own pixels stay as they are.
  cv::Mat turned = image, next;
  if (IsAcross(orientation)) {
    cv::transpose(image, next);
    turned = std::exchange(next, {});
  }
  if (IsMirroredAlongRows(orientation)) {
    cv::flip(turned, next, 1);
    turned = std::exchange(next, {});
  }
  if (IsMirroredAlongColumns(orientation)) {
    cv::flip(turned, next, 0);
    turned = next;
  }
  return turned;
}

Eigen::Vector2d UprightPixel(const Eigen::Vector2d& stored, int width, int height,
                             int orientation) {
  Eigen::Vector2d pixel = stored;
  Eigen::Vector2d last(width - 1, height - 1);
  if (IsAcross(orientation)) {
    std::swap(pixel.x(), pixel.y());
    std::swap(last.x(), last.y());
  }
  if (IsMirroredAlongRows(orientation)) pixel.x() = last.x() - pixel.x();
  if (IsMirroredAlongColumns(orientation)) pixel.y() = last.y() - pixel.y();
  return pixel;
}

WebResponse TileResponse(const cv::Mat& level_image, const ColorSpace& color, int level, int x,
                         int y) {
  const cv::Rect wanted(x * kTileSize, y * kTileSize, kTileSize, kTileSize);
  const cv::Mat cut = CutOut(level_image, color, wanted, cv::BORDER_REPLICATE);
  WebResponse response;
  response.type = level == 0 ? "image/png" : "image/jpeg";
  response.body = EncodedTile(cut, level == 0 ? TileCoding::kPng : TileCoding::kJpeg);
  return response;
}

WebResponse HatchedTile(const cv::Mat& shown, int level, int x, int y,
                        const std::function<bool(int x, int y)>& is_done) {
  const int side = kTileSize << level, step = 1 << level;
  const cv::Rect wanted = cv::Rect(x * side, y * side, side, side) & cv::Rect({0, 0}, shown.size());
  cv::Mat reduced;
  cv::resize(shown(wanted), reduced,
             {(wanted.width + step - 1) / step, (wanted.height + step - 1) / step}, 0, 0,
             cv::INTER_AREA);
  cv::Mat cut = CutOut(reduced, {}, {0, 0, kTileSize, kTileSize}, cv::BORDER_REPLICATE);
  Hatch(level, x, y, shown.size(), is_done, &cut);
  WebResponse response;
  response.type = "image/png";
  response.body = EncodedTile(cut, TileCoding::kPng);
  return response;
}

Json::Value ValueJson(const PixelValue& value) {
  Json::Value json;
  json["linear"] = ToJson(value.linear);
  json["encoded"] = ToJson(value.encoded);
  return json;
}

std::string FileVersion(const std::filesystem::path& file) {
  struct stat about = {};
  if (stat(file.c_str(), &about) != 0) return "";
  return std::to_string(about.st_mtim.tv_sec) + "." + std::to_string(about.st_mtim.tv_nsec) + "-" +
         std::to_string(about.st_ino) + "-" + std::to_string(about.st_size);
}

FilePicture::Content FilePicture::Read() {
  const std::lock_guard lock(mutex_);
  const std::string version = FileVersion(file_.path);
  if (!content_.pyramid || content_.version != version) {
    const cv::Mat image = UprightImage(ReadShownPhotograph(file_.path), file_.orientation);
    content_ = {version, std::make_shared<PhotoPyramid>(image, 0), ReadPhotographColor(file_.path)};
  }
  return content_;
}

PyramidSize FilePicture::Size() {
  Eigen::Vector2i size = ReadPhotographSize(file_.path);
  if (IsAcross(file_.orientation)) std::swap(size.x(), size.y());
  return PyramidSizeOf(size.x(), size.y());
}

WebResponse FilePicture::Tile(int level, int x, int y) {
  RequireTile(file_.path.string(), level, x, y);
  const Content content = Read();
  return TileResponse(content.pyramid->Level(level), content.color, level, x, y);
}

Json::Value FilePicture::Value(int x, int y) {
  RequirePixel(file_.path.string(), x, y);
  const Content content = Read();
  return ValueJson(PixelValueAt(content.pyramid->Level(0), content.color, x, y));
}

cv::Mat FilePicture::Image(ColorSpace* color) {
  const Content content = Read();
  *color = content.color;
  return content.pyramid->Level(0);
}

void FilePicture::Forget() {
  const std::lock_guard lock(mutex_);
  content_ = {};
}

}  // namespace insitu
