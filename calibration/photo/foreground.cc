// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/foreground.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using Color = Eigen::Array3f;

// One level of the pyramid.
struct MixedImage {
  int width = 0, height = 0;
  std::vector<Color> mixed;  // P
  std::vector<float> share;  // m
  size_t At(int x, int y) const { return static_cast<size_t>(y) * width + x; }
};

struct Parts {
  std::vector<Color> front, behind;  // F, B
};

bool IsFraction(float share) { return share > 0 && share < 1; }

// Of the pixels that are to be taken apart, with a margin to learn both colours from.
Eigen::AlignedBox2i BoxOfFractions(const Raster& share) {
  constexpr int kMargin = 32;  // [px]
  Eigen::AlignedBox2i box;
  for (int y = 0; y < share.height; ++y) {
    for (int x = 0; x < share.width; ++x) {
      if (IsFraction(*share.At(x, y))) box.extend(Eigen::Vector2i(x, y));
    }
  }
  if (box.isEmpty()) return box;
  const Eigen::Vector2i last(share.width - 1, share.height - 1);
  const Eigen::Vector2i margin = Eigen::Vector2i::Constant(kMargin);
  return {(box.min() - margin).cwiseMax(0), (box.max() + margin).cwiseMin(last)};
}

MixedImage CutOut(const Raster& photo, const Raster& share, const Eigen::AlignedBox2i& box) {
  const Eigen::Vector2i size = box.sizes() + Eigen::Vector2i::Ones();
  MixedImage image{size.x(), size.y(), {}, {}};
  for (int y = box.min().y(); y <= box.max().y(); ++y) {
    for (int x = box.min().x(); x <= box.max().x(); ++x) {
      image.mixed.push_back(photo.Rgb(x, y).cast<float>().array());
      image.share.push_back(*share.At(x, y));
    }
  }
  return image;
}

// Means of 2 x 2 pixels.
MixedImage Halved(const MixedImage& fine) {
  MixedImage half{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      Color color = Color::Zero();
      float share = 0;
      for (int i = 0; i < 4; ++i) {
        const size_t at = fine.At(std::min(2 * x + i % 2, fine.width - 1),
                                  std::min(2 * y + i / 2, fine.height - 1));
        color += fine.mixed[at] / 4;
        share += fine.share[at] / 4;
      }
      half.mixed.push_back(color);
      half.share.push_back(share);
    }
  }
  return half;
}

Parts Doubled(const Parts& coarse, const MixedImage& half, const MixedImage& fine) {
  Parts parts;
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const size_t at = half.At(x / 2, y / 2);
      parts.front.push_back(coarse.front[at]);
      parts.behind.push_back(coarse.behind[at]);
    }
  }
  return parts;
}

// The least squares of one pixel: P = m F + (1 - m) B, and F and B alike those of its neighbours,
// the more so where m changes between them.
void Relax(const MixedImage& image, int x, int y, Parts& parts) {
  constexpr float kSmoothness = 1e-5f;  // Germer et al., table 1
  const size_t here = image.At(x, y);
  const float m = image.share[here], n = 1 - m;
  float ff = m * m, bb = n * n;
  Color f = m * image.mixed[here], b = n * image.mixed[here];
  const auto pull = [&](size_t there) {
    const float weight = kSmoothness + std::abs(image.share[there] - m);
    ff += weight;
    bb += weight;
    f += weight * parts.front[there];
    b += weight * parts.behind[there];
  };
  if (x > 0) pull(here - 1);
  if (x + 1 < image.width) pull(here + 1);
  if (y > 0) pull(here - image.width);
  if (y + 1 < image.height) pull(here + image.width);
  const float determinant = ff * bb - m * n * m * n;
  if (determinant <= 0) return;  // a single pixel
  parts.front[here] = ((bb * f - m * n * b) / determinant).max(0);
  parts.behind[here] = ((ff * b - m * n * f) / determinant).max(0);
}

Parts Separate(const MixedImage& image) {
  if (image.width == 1 && image.height == 1) return {image.mixed, image.mixed};
  const MixedImage half = Halved(image);
  Parts parts = Doubled(Separate(half), half, image);
  const int rounds = std::max(image.width, image.height) <= 32 ? 10 : 2;  // Germer et al.
  for (int round = 0; round < rounds; ++round) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) Relax(image, x, y, parts);
    }
  }
  return parts;
}

// B with which the sum is exactly the photograph's: what is left over goes to both by least
// squares, as far as neither becomes negative.
Color ExactBehind(const Color& mixed, float m, const Color& front, const Color& behind) {
  const float n = 1 - m;
  const Color residual = mixed - m * front - n * behind;
  return (behind + n / (m * m + n * n) * residual).min(mixed.max(0) / n).max(0);
}

}  // namespace

Foreground SeparateForeground(const Raster& photo, Raster share) {
  INSITU_CHECK(share.channels == 1 && share.width == photo.width && share.height == photo.height);
  Foreground foreground{std::move(share), photo};
  const Eigen::AlignedBox2i box = BoxOfFractions(foreground.share);
  if (box.isEmpty()) return foreground;
  const MixedImage image = CutOut(photo, foreground.share, box);
  const Parts parts = Separate(image);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const size_t at = image.At(x, y);
      if (!IsFraction(image.share[at])) continue;
      const Color behind =
          ExactBehind(image.mixed[at], image.share[at], parts.front[at], parts.behind[at]);
      foreground.behind.SetRgb(box.min().x() + x, box.min().y() + y,
                               behind.matrix().cast<double>());
    }
  }
  return foreground;
}

}  // namespace insitu
