// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/undistort_file.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/lens/interpolate_bicubic.h"
#include "calibration/lens/sight_map.h"
#include "calibration/photo/linear_rows.h"

namespace insitu {
namespace {

constexpr int kBand = 4 * kExrTile;  // rows

const Eigen::Vector2d kUnseen = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

// Where the photograph shows each pixel of some rows; kUnseen: nowhere.
std::vector<Eigen::Vector2d> SourcePixels(const Camera& source, const SightMap& sights, int width,
                                          int first, int rows) {
  std::vector<Eigen::Vector2d> pixels(static_cast<size_t>(width) * rows, kUnseen);
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const auto pixel = source.Project(sights.Direction(Eigen::Vector2d(x, first + y)));
      if (pixel && source.Sees(*pixel)) pixels[static_cast<size_t>(y) * width + x] = *pixel;
    }
  });
  return pixels;
}

Raster ReprojectedRows(const CodedPhotograph& photo, const std::vector<Eigen::Vector2d>& pixels,
                       int width, int rows) {
  Raster image(width, rows);
  double top = photo.height, bottom = -1;
  for (const Eigen::Vector2d& pixel : pixels) {
    if (std::isnan(pixel.y())) continue;
    top = std::min(top, pixel.y());
    bottom = std::max(bottom, pixel.y());
  }
  if (bottom < top) return image;
  // What the four taps of the outermost pixels need; at the photograph's border they are clamped.
  const int first = std::clamp(static_cast<int>(std::floor(top)) - 1, 0, photo.height - 1);
  const int end = std::clamp(static_cast<int>(std::floor(bottom)) + 3, first + 1, photo.height);
  const Raster window = LinearRows(photo, first, end);
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector2d& pixel = pixels[static_cast<size_t>(y) * width + x];
      if (std::isnan(pixel.y())) continue;
      image.SetRgb(x, y, InterpolateBicubic(window, pixel - Eigen::Vector2d(0, first)));
    }
  });
  return image;
}

}  // namespace

void WriteReprojected(const std::filesystem::path& exr, const CodedPhotograph& photo,
                      const Camera& source, const Camera& target) {
  INSITU_CHECK(photo.width == source.width() && photo.height == source.height());
  const SightMap sights(target);
  WriteWhole(exr, [&](const std::filesystem::path& temporary) {
    ExrRows output(temporary, target.width(), target.height());
    for (int first = 0; first < target.height(); first += kBand) {
      const int rows = std::min(kBand, target.height() - first);
      output.Append(ReprojectedRows(
          photo, SourcePixels(source, sights, target.width(), first, rows), target.width(), rows));
    }
    output.Close();
  });
}

}  // namespace insitu
