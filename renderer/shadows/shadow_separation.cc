// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/shadows/shadow_separation.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kFewestPixels = 400;        // of a surface that is judged
constexpr int kMostForModel = 20000;      // pixels of a surface that its model is made from
constexpr double kLeastFall = 0.25;       // ln, of a sun whose absence is seen
constexpr int kPasses = 25;               // of expectation maximisation
constexpr double kOutlierDensity = 0.02;  // per ln^3: colours of anything else
constexpr double kMostOffset = 0.5;       // ln: what casts the shadow also takes from the sky
constexpr double kOffsetPixels = 200;     // that it takes to believe in such an offset

constexpr int kSweeps = 20;        // of the mean field
constexpr double kCoupling = 0.7;  // ln odds, of like neighbours
constexpr double kLikeness = 0.3;  // ln, difference of neighbours that are not alike
constexpr double kMostOdds = 5;    // ln, that a pixel alone can bring

Vector3d Lit(const SunPixel& pixel) { return pixel.lit.cast<double>(); }
Vector3d Shaded(const SunPixel& pixel) { return (pixel.lit - pixel.fall).cast<double>(); }

struct Odds {
  double lit = 0, shaded = 0, other = 0;  // sum 1
};

// What is known of a surface's colours.
struct SurfaceModel {
  Vector3d mean = Vector3d::Zero();    // ln of its reflectance, on the photograph's scale
  Vector3d offset = Vector3d::Zero();  // of shaded pixels beyond the sun's absence
  Matrix3d covariance = Matrix3d::Identity();
  double lit = 0.85, shaded = 0.1, other = 0.05;  // shares
};

// What pixels of a surface are by its model, with what all of them share.
class Classes {
 public:
  explicit Classes(const SurfaceModel& model)
      : model_(model),
        inverse_(model.covariance.inverse()),
        scale_(1 / std::sqrt(std::pow(2 * M_PI, 3) * model.covariance.determinant())) {}

  Odds Of(const SunPixel& pixel) const {
    Odds odds{model_.lit * Density(Lit(pixel) - model_.mean),
              model_.shaded * Density(Shaded(pixel) - model_.mean - model_.offset),
              model_.other * kOutlierDensity};
    const double sum = odds.lit + odds.shaded + odds.other;
    return {odds.lit / sum, odds.shaded / sum, odds.other / sum};
  }

  // Of shade against sun, by the pixel alone; what fits neither brings little.
  double LogOdds(const SunPixel& pixel) const {
    const Odds odds = Of(pixel);
    const double shaded = odds.shaded + 0.3 * odds.other, lit = odds.lit + 0.7 * odds.other;
    const double log_odds = std::log(std::max(shaded, 1e-9) / std::max(lit, 1e-9));
    return std::clamp(log_odds, -kMostOdds, kMostOdds);
  }

 private:
  double Density(const Vector3d& off) const {
    return scale_ * std::exp(-off.dot(inverse_ * off) / 2);
  }

  SurfaceModel model_;
  Matrix3d inverse_;
  double scale_;
};

double Brightness(const SunPixel& pixel) { return pixel.lit.mean(); }

// Most of a surface is lit: from the middle of its brighter half, with the scatter of stone.
SurfaceModel FirstGuess(std::vector<SunPixel> pixels) {
  std::ranges::sort(pixels, {}, Brightness);
  SurfaceModel model;
  const size_t from = pixels.size() * 55 / 100, to = pixels.size() * 85 / 100;
  for (size_t i = from; i < to; ++i) model.mean += Lit(pixels[i]);
  model.mean /= static_cast<double>(to - from);
  model.covariance = 0.02 * Matrix3d::Ones() + 0.005 * Matrix3d::Identity();
  return model;
}

SurfaceModel Improved(const SurfaceModel& model, const std::vector<SunPixel>& pixels) {
  double lit = 0, shaded = 0;
  Vector3d sum_lit = Vector3d::Zero(), sum_shaded = Vector3d::Zero();
  std::vector<Odds> odds;
  const Classes classes(model);
  for (const SunPixel& pixel : pixels) {
    odds.push_back(classes.Of(pixel));
    lit += odds.back().lit;
    shaded += odds.back().shaded;
    sum_lit += odds.back().lit * Lit(pixel);
    sum_shaded += odds.back().shaded * Shaded(pixel);
  }
  SurfaceModel next;
  next.mean = (sum_lit + sum_shaded - shaded * model.offset) / std::max(lit + shaded, 1e-9);
  const Vector3d off = (sum_shaded - shaded * next.mean) / (shaded + kOffsetPixels);
  next.offset = Vector3d::Constant(std::clamp(off.mean(), -kMostOffset, 0.0));
  // Of lit pixels: stains that are nearly as dark as shade must not widen what passes for it.
  next.covariance = 1e-4 * Matrix3d::Identity();
  for (size_t i = 0; i < pixels.size(); ++i) {
    const Vector3d off_mean = Lit(pixels[i]) - next.mean;
    next.covariance += odds[i].lit / std::max(lit, 1e-9) * off_mean * off_mean.transpose();
  }
  const double all = static_cast<double>(pixels.size());
  next.lit = (lit + 1) / (all + 3);
  next.shaded = (shaded + 1) / (all + 3);
  next.other = 1 - next.lit - next.shaded;
  return next;
}

// nullopt: it cannot be judged.
std::optional<Classes> ClassesOf(const std::vector<SunPixel>& pixels) {
  if (pixels.size() < kFewestPixels) return std::nullopt;
  double fall = 0;
  for (const SunPixel& pixel : pixels) fall -= pixel.fall.mean();
  if (fall / static_cast<double>(pixels.size()) < kLeastFall) return std::nullopt;
  SurfaceModel model = FirstGuess(pixels);
  for (int pass = 0; pass < kPasses; ++pass) model = Improved(model, pixels);
  return Classes(model);
}

// Of each surface number, from at most kMostForModel of its pixels.
std::vector<std::optional<Classes>> ClassesBySurface(const std::vector<SunPixel>& pixels) {
  std::vector<size_t> counts;
  for (const SunPixel& pixel : pixels) {
    if (pixel.surface < 0) continue;
    if (counts.size() <= static_cast<size_t>(pixel.surface)) counts.resize(pixel.surface + 1);
    ++counts[pixel.surface];
  }
  std::vector<size_t> seen(counts.size());
  std::vector<std::vector<SunPixel>> of_surface(counts.size());
  for (const SunPixel& pixel : pixels) {
    if (pixel.surface < 0) continue;
    const size_t step = counts[pixel.surface] / kMostForModel + 1;
    if (seen[pixel.surface]++ % step == 0) of_surface[pixel.surface].push_back(pixel);
  }
  std::vector<std::optional<Classes>> classes(counts.size());
  tbb::parallel_for(size_t{0}, counts.size(),
                    [&](size_t i) { classes[i] = ClassesOf(of_surface[i]); });
  return classes;
}

// The picture with what each pixel tells of itself.
class ShadowField {
 public:
  ShadowField(int width, int height, const std::vector<SunPixel>& pixels)
      : width_(width),
        height_(height),
        pixels_(pixels),
        evidence_(pixels.size()),
        shade_(pixels.size()),
        is_judged_(pixels.size()),
        couplings_(pixels.size(), Couplings{}) {
    const std::vector<std::optional<Classes>> classes = ClassesBySurface(pixels);
    ForEachRow([&](int y) {
      for (size_t i = Index(0, y); i < Index(0, y + 1); ++i) {
        const int surface = pixels[i].surface;
        if (surface < 0 || !classes[surface]) continue;
        evidence_[i] = static_cast<float>(classes[surface]->LogOdds(pixels[i]));
        shade_[i] = Probability(evidence_[i]);
        is_judged_[i] = 1;
      }
    });
    ForEachRow([this](int y) { CoupleRow(y); });
  }

  void Sweep() {
    std::vector<float> next = shade_;
    ForEachRow([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const size_t i = Index(x, y);
        if (is_judged_[i]) next[i] = Probability(evidence_[i] + NeighboursOdds(x, y));
      }
    });
    shade_.swap(next);
  }

  SunShares Shares() const {
    SunShares shares{Raster(width_, height_, 1), Raster(width_, height_, 1)};
    for (size_t i = 0; i < pixels_.size(); ++i) {
      shares.share.data[i] = is_judged_[i] ? 1 - shade_[i] : 1;
      shares.sigma.data[i] = is_judged_[i] ? std::sqrt(shade_[i] * (1 - shade_[i])) : 0;
    }
    return shares;
  }

 private:
  // Right of a pixel, and below it to the left, straight and to the right: [ln odds] by which it
  // and that neighbour draw each other, 0 across a surface's edge.
  struct Step {
    int x, y;
  };
  static constexpr std::array<Step, 4> kSteps = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  using Couplings = std::array<float, kSteps.size()>;

  size_t Index(int x, int y) const { return static_cast<size_t>(y) * width_ + x; }
  bool Holds(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }
  template <typename Task>
  void ForEachRow(const Task& task) const {
    tbb::parallel_for(0, height_, task);
  }
  static float Probability(double log_odds) {
    return static_cast<float>(1 / (1 + std::exp(-log_odds)));
  }

  void CoupleRow(int y) {
    for (int x = 0; x < width_; ++x) {
      const size_t i = Index(x, y);
      if (!is_judged_[i]) continue;
      for (size_t k = 0; k < kSteps.size(); ++k) {
        if (!Holds(x + kSteps[k].x, y + kSteps[k].y)) continue;
        const SunPixel& there = pixels_[Index(x + kSteps[k].x, y + kSteps[k].y)];
        if (there.surface != pixels_[i].surface) continue;
        const double off = (Brightness(there) - Brightness(pixels_[i])) / kLikeness;
        couplings_[i][k] = static_cast<float>(kCoupling * std::exp(-off * off / 2));
      }
    }
  }

  double NeighboursOdds(int x, int y) const {
    double odds = 0;
    for (size_t k = 0; k < kSteps.size(); ++k) {
      const Step& step = kSteps[k];
      if (Holds(x + step.x, y + step.y)) {
        odds += couplings_[Index(x, y)][k] * (2 * shade_[Index(x + step.x, y + step.y)] - 1);
      }
      if (Holds(x - step.x, y - step.y)) {
        const size_t j = Index(x - step.x, y - step.y);
        odds += couplings_[j][k] * (2 * shade_[j] - 1);
      }
    }
    return odds;
  }

  int width_, height_;
  const std::vector<SunPixel>& pixels_;
  std::vector<float> evidence_, shade_;  // ln odds by the pixel alone, probability
  std::vector<char> is_judged_;
  std::vector<Couplings> couplings_;
};

}  // namespace

SunShares SeparateShadows(int width, int height, const std::vector<SunPixel>& pixels) {
  INSITU_CHECK(pixels.size() == static_cast<size_t>(width) * height);
  ShadowField field(width, height, pixels);
  for (int sweep = 0; sweep < kSweeps; ++sweep) field.Sweep();
  return field.Shares();
}

}  // namespace insitu
