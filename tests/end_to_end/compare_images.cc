// SPDX-License-Identifier: GPL-3.0-or-later
// Compares images for the end-to-end tests.
//   compare_images identical A B [MASK]
//       status 0 if the decoded pixels are equal; with MASK only where it is 0 all around, since
//       a mask made of a few samples a pixel is not exact at its borders.
//   compare_images error MONTAGE TRUTH BEFORE MASK MAX_RATIO
//       status 0 if, where MASK is not 0, the sRGB RMS error against TRUTH is at most MAX_RATIO
//       of that of BEFORE, the photograph without the building.
//   compare_images colors A B MAX
//       status 0 if the mean colour difference (CIE 1976, of what sRGB shows) is at most MAX.
#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

Raster ReadLinear(const std::string& path) { return ReadPhotograph(path).linear; }

void RequireSameSize(const Raster& a, const Raster& b) {
  if (a.width != b.width || a.height != b.height) throw std::runtime_error("sizes differ");
}

// Sum over the channels of the squared difference of two pixels, sRGB encoded.
double SquaredError(const Raster& a, const Raster& b, int x, int y) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const auto encoded = [&](const Raster& image) {
      return SrgbFromLinear(std::clamp<double>(image.At(x, y)[c], 0, 1));
    };
    sum += std::pow(encoded(a) - encoded(b), 2);
  }
  return sum;
}

constexpr int kMargin = 4;  // [px]

bool IsZeroAround(const Raster& mask, int x, int y) {
  const int right = std::min(x + kMargin, mask.width - 1);
  const int bottom = std::min(y + kMargin, mask.height - 1);
  for (int v = std::max(y - kMargin, 0); v <= bottom; ++v) {
    for (int u = std::max(x - kMargin, 0); u <= right; ++u) {
      if (mask.At(u, v)[0] > 0) return false;
    }
  }
  return true;
}

bool AreIdentical(const std::vector<std::string>& files) {
  const Raster a = ReadLinear(files[0]), b = ReadLinear(files[1]);
  const Raster mask = files.size() > 2 ? ReadLinear(files[2]) : Raster(a.width, a.height);
  RequireSameSize(a, b);
  RequireSameSize(a, mask);
  int compared = 0, different = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (!IsZeroAround(mask, x, y)) continue;
      ++compared;
      different += a.Rgb(x, y) != b.Rgb(x, y);
    }
  }
  std::cout << different << " of " << compared << " pixels differ\n";
  return compared > 0 && different == 0;
}

bool IsErrorBelow(const std::vector<std::string>& files, double max_ratio) {
  const Raster montage = ReadLinear(files[0]), truth = ReadLinear(files[1]);
  const Raster before = ReadLinear(files[2]), mask = ReadLinear(files[3]);
  for (const Raster* image : {&truth, &before, &mask}) RequireSameSize(montage, *image);
  double error = 0, nothing = 0;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.At(x, y)[0] == 0) continue;
      error += SquaredError(montage, truth, x, y);
      nothing += SquaredError(before, truth, x, y);
    }
  }
  const double ratio = std::sqrt(error / nothing);
  std::cout << "error " << ratio << " of that of doing nothing, at most " << max_ratio << "\n";
  return ratio <= max_ratio;  // false for NaN too: a mask without changed pixels
}

// CIE L*a*b* under the white of Rec. 709 [CIE 015:2018, 8.2.1]; what no screen shows is clipped.
Eigen::Vector3d Lab(const Eigen::Vector3d& linear) {
  static const Eigen::Matrix3d xyz = XyzFromRgb(kRec709);
  static const Eigen::Vector3d white = xyz * Eigen::Vector3d::Ones();
  const Eigen::Vector3d share =
      (xyz * linear.cwiseMax(0).cwiseMin(1)).cwiseQuotient(white).unaryExpr([](double t) {
        return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29;
      });
  return {116 * share[1] - 16, 500 * (share[0] - share[1]), 200 * (share[1] - share[2])};
}

bool AreColorsNear(const std::vector<std::string>& files, double most) {
  const Raster a = ReadLinear(files[0]), b = ReadLinear(files[1]);
  RequireSameSize(a, b);
  double sum = 0, largest = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double difference = (Lab(a.Rgb(x, y)) - Lab(b.Rgb(x, y))).norm();
      sum += difference;
      largest = std::max(largest, difference);
    }
  }
  const double mean = sum / a.width / a.height;
  std::cout << "mean colour difference " << mean << ", at most " << most << "; largest " << largest
            << "\n";
  return mean <= most;
}

bool Compare(const std::vector<std::string>& arguments) {
  const std::string mode = arguments.empty() ? "" : arguments[0];
  const std::vector<std::string> rest(arguments.begin() + !arguments.empty(), arguments.end());
  if (mode == "identical" && (rest.size() == 2 || rest.size() == 3)) return AreIdentical(rest);
  if (mode == "error" && rest.size() == 5) return IsErrorBelow(rest, std::stod(rest[4]));
  if (mode == "colors" && rest.size() == 3) return AreColorsNear(rest, std::stod(rest[2]));
  throw std::runtime_error(
      "expected identical A B [MASK], error A TRUTH BEFORE MASK MAX_RATIO or colors A B MAX");
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) {
  try {
    return insitu::Compare({argv + 1, argv + argc}) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "compare_images: " << error.what() << "\n";
    return 2;
  }
}
