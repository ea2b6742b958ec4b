// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/made_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/tiles/shown_image.h"

namespace insitu {
namespace {

constexpr double kEnlarged = 8;  // a difference of 32 codes is white
constexpr double kLeastShown = 24;

uint8_t ByteOf(double code) {
  return static_cast<uint8_t>(std::lround(std::clamp(code, 0., 255.)));
}

// [codes of 8 bits]
Eigen::Vector3d CodesBetween(const cv::Vec3f& before, const cv::Vec3f& after) {
  Eigen::Vector3d codes;
  for (int c = 0; c < 3; ++c) {
    codes[c] = 255 * (SrgbFromLinear(after[c]) - SrgbFromLinear(before[c]));
  }
  return codes;
}

// Red first, upright.
cv::Mat LinearImage(const PictureFile& file) {
  Photograph photo = ReadPhotograph(file.path);
  const cv::Mat stored(photo.linear.height, photo.linear.width, CV_32FC3, photo.linear.data.data());
  return UprightImage(stored, file.orientation).clone();
}

}  // namespace

std::shared_ptr<PhotoPyramid> MadePicture::Made() {
  const std::lock_guard lock(mutex_);
  const std::string version = Version();
  if (!pyramid_ || version != version_) {
    pyramid_ = std::make_shared<PhotoPyramid>(Make(), 0);
    version_ = version;
  }
  return pyramid_;
}

PyramidSize MadePicture::Size() {
  const cv::Mat image = Made()->Level(0);
  return PyramidSizeOf(image.cols, image.rows);
}

WebResponse MadePicture::Tile(int level, int x, int y) {
  RequireTile(Name(), level, x, y);
  return TileResponse(Made()->Level(level), {}, level, x, y);
}

Json::Value MadePicture::Value(int x, int y) {
  RequirePixel(Name(), x, y);
  Json::Value value = ValueJson(PixelValueAt(Made()->Level(0), {}, x, y));
  AddValue(x, y, &value);
  return value;
}

void MadePicture::Forget() {
  const std::lock_guard lock(mutex_);
  pyramid_.reset();
}

cv::Mat LayerPicture::Make() {
  ColorSpace color;
  const cv::Mat layers = picture_.Image(&color);
  cv::Mat shown(layers.size(), CV_8UC3);
  for (int y = 0; y < layers.rows; ++y) {
    for (int x = 0; x < layers.cols; ++x) {
      const uint8_t code = ByteOf(255. * layers.ptr<float>(y)[3 * x + 2 - channel_]);
      shown.at<cv::Vec3b>(y, x) = {code, code, code};
    }
  }
  return shown;
}

void LayerPicture::AddValue(int x, int y, Json::Value* value) {
  ColorSpace color;
  (*value)["share"] = picture_.Image(&color).ptr<float>(y)[3 * x + 2 - channel_];
}

DifferencePicture::DifferencePicture(PictureFile before, PictureFile after)
    : before_(std::move(before)), after_(std::move(after)) {
  const PyramidSize a = FilePicture(before_).Size(), b = FilePicture(after_).Size();
  if (a.width == b.width && a.height == b.height) return;
  throw InputError("difference", "of pictures of " + SizeText(a.width, a.height) + " and " +
                                     SizeText(b.width, b.height) + ", expected one size");
}

cv::Mat DifferencePicture::Make() {
  linear_before_ = LinearImage(before_);
  linear_after_ = LinearImage(after_);
  differing_ = 0;
  most_ = 0;
  cv::Mat shown(linear_before_.size(), CV_8UC3, cv::Scalar(0, 0, 0));
  for (int y = 0; y < shown.rows; ++y) {
    for (int x = 0; x < shown.cols; ++x) {
      const auto& before = linear_before_.at<cv::Vec3f>(y, x);
      const auto& after = linear_after_.at<cv::Vec3f>(y, x);
      if (before == after) continue;
      const Eigen::Vector3d codes = CodesBetween(before, after).cwiseAbs();
      ++differing_;
      most_ = std::max(most_, codes.maxCoeff());
      for (int c = 0; c < 3; ++c) {
        shown.at<cv::Vec3b>(y, x)[2 - c] = ByteOf(std::max(kEnlarged * codes[c], kLeastShown));
      }
    }
  }
  return shown;
}

void DifferencePicture::AddValue(int x, int y, Json::Value* value) {
  const std::lock_guard lock(mutex_);
  if (linear_before_.empty()) return;  // forgotten meanwhile
  const auto& before = linear_before_.at<cv::Vec3f>(y, x);
  const auto& after = linear_after_.at<cv::Vec3f>(y, x);
  (*value)["codes"] = ToJson(CodesBetween(before, after));
  for (int c = 0; c < 3; ++c) (*value)["linear"][c] = after[c] - before[c];
}

void DifferencePicture::Forget() {
  const std::lock_guard lock(mutex_);
  MadePicture::Forget();
  linear_before_.release();
  linear_after_.release();
}

Json::Value DifferencePicture::Summary() {
  const PyramidSize size = Size();  // makes it
  const std::lock_guard lock(mutex_);
  Json::Value summary;
  summary["differing"] = static_cast<Json::Int64>(differing_);
  summary["of"] = static_cast<Json::Int64>(int64_t{size.width} * size.height);
  summary["most"] = most_;
  return summary;
}

}  // namespace insitu
