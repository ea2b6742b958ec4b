// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/shown_image.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "calibration/tiles/photo_pyramid.h"

namespace insitu {
namespace {

constexpr int kJpegQuality = 85, kPngCompression = 1;

double CodeAt(const cv::Mat& image, int x, int y, int channel) {
  switch (image.depth()) {
    case CV_8U:
      return image.ptr<uint8_t>(y)[3 * x + channel] / 255.;
    case CV_16U:
      return image.ptr<uint16_t>(y)[3 * x + channel] / 65535.;
    default:
      return image.ptr<float>(y)[3 * x + channel];
  }
}

}  // namespace

PixelValue PixelValueAt(const cv::Mat& image, const ColorSpace& color, int x, int y) {
  const Eigen::Vector3d code(CodeAt(image, x, y, 2), CodeAt(image, x, y, 1),
                             CodeAt(image, x, y, 0));
  const bool is_linear = image.depth() == CV_32F && color.IsDefault();
  PixelValue value;
  value.linear = is_linear ? code : color.Linear(code);
  value.encoded =
      color.IsDefault() && !is_linear ? code : value.linear.unaryExpr(&SrgbFromLinear).eval();
  return value;
}

cv::Mat CutOut(const cv::Mat& image, const ColorSpace& color, const cv::Rect& wanted, int border) {
  const cv::Rect inside = wanted & cv::Rect({0, 0}, image.size());
  cv::Mat cut;
  cv::copyMakeBorder(EightBit(image(inside), color), cut, inside.y - wanted.y,
                     wanted.br().y - inside.br().y, inside.x - wanted.x,
                     wanted.br().x - inside.br().x, border);
  return cut;
}

std::string EncodedTile(const cv::Mat& image, TileCoding coding) {
  const bool is_jpeg = coding == TileCoding::kJpeg;
  const std::vector<int> parameters =
      is_jpeg ? std::vector{+cv::IMWRITE_JPEG_QUALITY, kJpegQuality}
              : std::vector{+cv::IMWRITE_PNG_COMPRESSION, kPngCompression};
  std::vector<unsigned char> bytes;
  INSITU_CHECK(cv::imencode(is_jpeg ? ".jpg" : ".png", image, bytes, parameters));
  return {bytes.begin(), bytes.end()};
}

}  // namespace insitu
