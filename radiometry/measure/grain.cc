// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calibration/algebra/decompositions.h"
#include "radiometry/measure/measure_image_quality.h"
#include "radiometry/measure/robust_weights.h"

namespace insitu {
namespace {

constexpr int kBlock = 8;               // [px]
constexpr int kPlane = 4;               // unknowns of what is taken off a block
constexpr int kLevels = 16;             // of radiance, as many blocks in each
constexpr double kEven = 0.1;           // share of a level's blocks that are taken for even
constexpr double kLongestGrain = 2;     // [px], that a block tells of the grain
constexpr double kLeastSpread = 1e-12;  // variance below which a block is drawn, not photographed

struct Block {
  Eigen::Vector3d mean, variance;
  double unevenness = 0;  // variance of the block to its left, whose noise is another
  double next = 0;        // covariance with the pixel beside or below, of green
  double shared = 0;      // mean covariance of the channels, as a share of their variances
};

using Pixels = Eigen::Matrix<double, kBlock * kBlock, 3>;

// Takes a block's mean and gradients away: light falls off, too.
Eigen::MatrixXd MakeRemovePlane() {
  constexpr int kPixels = kBlock * kBlock;
  Eigen::MatrixXd plane(kPixels, kPlane);
  for (int i = 0; i < kPixels; ++i) {
    const int column = i % kBlock, row = i / kBlock;
    const double x = column - (kBlock - 1) / 2.0, y = row - (kBlock - 1) / 2.0;
    plane.row(i) << 1, x, y, x * y;
  }
  const Eigen::Matrix4d cofactor = Eigen::Matrix4d(plane.transpose() * plane).inverse();
  const Eigen::MatrixXd scaled = plane * cofactor;
  return Eigen::MatrixXd::Identity(kPixels, kPixels) - scaled * plane.transpose();
}

const Eigen::MatrixXd& RemovePlane() {
  static const Eigen::MatrixXd remove = MakeRemovePlane();
  return remove;
}

// Mean of a function of two pixels of a block that are neighbours along a row or a column.
template <typename Product>
double MeanOverNeighbours(Product product) {
  double sum = 0;
  for (int y = 0; y < kBlock; ++y) {
    for (int x = 0; x + 1 < kBlock; ++x) {
      sum += product(y * kBlock + x, y * kBlock + x + 1);
      sum += product(x * kBlock + y, (x + 1) * kBlock + y);
    }
  }
  return sum / (2 * kBlock * (kBlock - 1));
}

std::optional<Block> ReadBlock(const Photograph& photo, int left, int top) {
  Pixels pixels;
  for (int i = 0; i < kBlock * kBlock; ++i) {
    const int x = left + i % kBlock, y = top + i / kBlock;
    if (IsClipped(photo, x, y)) return std::nullopt;
    pixels.row(i) = photo.linear.Rgb(x, y);
  }
  const Pixels residuals = RemovePlane() * pixels;
  const Eigen::Matrix3d covariance = residuals.transpose() * residuals / (kBlock * kBlock - kPlane);
  if (covariance.trace() < kLeastSpread) return std::nullopt;
  const Eigen::Vector3d sigma = covariance.diagonal().cwiseSqrt().cwiseMax(1e-9);
  Block block;
  block.mean = pixels.colwise().mean();
  block.variance = covariance.diagonal();
  block.next = MeanOverNeighbours([&](int a, int b) { return residuals(a, 1) * residuals(b, 1); });
  block.shared =
      (covariance(0, 1) / (sigma[0] * sigma[1]) + covariance(0, 2) / (sigma[0] * sigma[2]) +
       covariance(1, 2) / (sigma[1] * sigma[2])) /
      3;
  return block;
}

using Level = std::vector<Block>;

// The evenest tenth of the blocks at each of several radiances. Chosen by their neighbours, their
// own variances are not lower than the rest's.
std::vector<Level> EvenBlocks(std::vector<Block> blocks) {
  std::sort(blocks.begin(), blocks.end(),
            [](const Block& a, const Block& b) { return a.mean.sum() < b.mean.sum(); });
  const auto at = [&blocks](int level) {
    return blocks.begin() + static_cast<std::ptrdiff_t>(blocks.size() * level / kLevels);
  };
  std::vector<Level> levels;
  for (int level = 0; level < kLevels; ++level) {
    const auto first = at(level), last = at(level + 1);
    const auto end = first + static_cast<std::ptrdiff_t>(kEven * static_cast<double>(last - first));
    std::partial_sort(first, end, last,
                      [](const Block& a, const Block& b) { return a.unevenness < b.unevenness; });
    if (end != first) levels.emplace_back(first, end);
  }
  return levels;
}

// The median of a property of blocks.
template <typename Property>
double MedianOf(const Level& blocks, Property property) {
  std::vector<double> values;
  for (const Block& block : blocks) values.push_back(property(block));
  return Median(std::move(values));
}

// Variance that rounding to 8 bits adds in linear light: 1/12 code, at the curve's steepness.
double RoundingVariance(double linear, Encoding encoding) {
  if (encoding != Encoding::kSrgb8) return 0;
  const double code = SrgbFromLinear(std::clamp(linear, 0.0, 1.0));
  const double step = LinearFromSrgb(std::min(1.0, code + 0.5 / 255)) -
                      LinearFromSrgb(std::max(0.0, code - 0.5 / 255));
  return step * step / 12;
}

// Of one channel: floor and slope, neither negative; levels weigh by their relative error.
Eigen::Vector2d FitVariance(const std::vector<Level>& levels, int channel, Encoding encoding) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const Level& blocks : levels) {
    const double mean = std::max(0.0, MedianOf(blocks, [&](auto& b) { return b.mean[channel]; }));
    const double variance = MedianOf(blocks, [&](auto& b) { return b.variance[channel]; });
    const double grain = std::max(0.0, variance - RoundingVariance(mean, encoding));
    const double weight = static_cast<double>(blocks.size()) / std::pow(variance + kLeastSpread, 2);
    const Eigen::Vector2d row(1, mean);
    normal += weight * row * row.transpose();
    right += weight * row * grain;
  }
  const Eigen::Vector2d fit = SolveSymmetric(normal, right);
  if (fit[0] < 0) return {0, std::max(0.0, right[1] / normal(1, 1))};
  if (fit[1] < 0) return {std::max(0.0, right[0] / normal(0, 0)), 0};
  return fit;
}

// Correlation of white noise at a lag [px] along a row, smoothed with a Gaussian as UnitGrain does.
double Autocorrelation(double length, int lag) {
  if (length <= 0) return lag == 0 ? 1 : 0;
  const int reach = static_cast<int>(std::ceil(3 * length));
  const auto weight = [&](int at) {
    return std::abs(at) > reach ? 0 : std::exp(-at * at / (2 * length * length));
  };
  double product = 0, square = 0;
  for (int at = -reach; at <= reach; ++at) {
    product += weight(at) * weight(at + lag);
    square += weight(at) * weight(at);
  }
  return product / square;
}

// What is left in a block of noise of unit variance: variance and covariance of neighbours.
struct Left {
  double variance, next;
};

Left LeftInBlock(double length) {
  std::array<double, kBlock> along;
  for (int lag = 0; lag < kBlock; ++lag) along[lag] = Autocorrelation(length, lag);
  Eigen::MatrixXd noise(kBlock * kBlock, kBlock * kBlock);
  for (int a = 0; a < kBlock * kBlock; ++a) {
    for (int b = 0; b < kBlock * kBlock; ++b) {
      noise(a, b) =
          along[std::abs(a % kBlock - b % kBlock)] * along[std::abs(a / kBlock - b / kBlock)];
    }
  }
  const Eigen::MatrixXd across = RemovePlane() * noise, left = across * RemovePlane();
  return {left.trace() / (kBlock * kBlock - kPlane),
          MeanOverNeighbours([&](int a, int b) { return left(a, b); })};
}

// Sigma [px] of the Gaussian that white noise was smoothed with, for `next` over variance of what
// is left in a block: it grows with the length.
double SmoothingLength(double ratio) {
  double low = 0, high = kLongestGrain;
  for (int i = 0; i < 24; ++i) {
    const double middle = (low + high) / 2;
    const Left left = LeftInBlock(middle);
    (left.next / left.variance < ratio ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

std::optional<Grain> MeasureGrain(const Photograph& photo) {
  std::vector<Block> blocks;
  for (int top = 0; top + kBlock <= photo.linear.height; top += kBlock) {
    for (int left = 0; left + 2 * kBlock <= photo.linear.width; left += 2 * kBlock) {
      const auto chosen_by = ReadBlock(photo, left, top);
      auto block = chosen_by ? ReadBlock(photo, left + kBlock, top) : std::nullopt;
      if (!block) continue;
      block->unevenness = chosen_by->variance.sum();
      blocks.push_back(*block);
    }
  }
  const std::vector<Level> levels = EvenBlocks(std::move(blocks));
  Level even;
  for (const Level& level : levels) even.insert(even.end(), level.begin(), level.end());
  if (even.size() < kFewestPatches) return std::nullopt;
  Grain grain;
  grain.length = SmoothingLength(MedianOf(even, [](auto& b) { return b.next / b.variance[1]; }));
  const double left = LeftInBlock(grain.length).variance;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector2d fit = FitVariance(levels, c, photo.encoding) / left;
    grain.floor[c] = fit[0];
    grain.slope[c] = fit[1];
  }
  grain.shared = std::clamp(MedianOf(even, [](auto& b) { return b.shared; }), 0.0, 1.0);
  grain.patches = static_cast<int>(even.size());
  return grain;
}

}  // namespace insitu
