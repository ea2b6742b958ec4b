// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_response.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "calibration/files/error.h"
#include "radiometry/measure/robust_weights.h"

namespace insitu {
namespace {

constexpr int kKnots = 17, kCellsBetween = 8, kCells = (kKnots - 1) * kCellsBetween;
constexpr int kRounds = 12, kWideRounds = 6;  // wide: Tukey's weights reach farther at first
constexpr double kTukey = 3, kWide = 3;
constexpr int kSlopeCells = 3;         // on each side, that the slope at a code is over
constexpr double kMiddleSigma = 0.01;  // of the slope at the middle knot: a curve's scale is free
constexpr double kKnownSigma = 0.001;  // of a known reflectance
constexpr double kFaintestLight = 0.001;  // that a slope is taken over

template <typename Number>
using Borders = std::array<Number, kCells + 1>;  // light at each cell's border

// Light that sRGB has between the borders of each cell of codes.
const std::array<double, kCells>& SrgbSteps() {
  static const std::array<double, kCells> steps = [] {
    std::array<double, kCells> all = {};
    for (int i = 0; i < kCells; ++i) {
      all[i] = LinearFromSrgb((i + 1.0) / kCells) - LinearFromSrgb(double(i) / kCells);
    }
    return all;
  }();
  return steps;
}

// By the logarithms of the slopes at the knots; the last one is 1.
template <typename Number>
Borders<Number> LightAtBorders(const Number* slopes) {
  Borders<Number> light;
  light[0] = Number(0);
  for (int i = 0; i < kCells; ++i) {
    const double at = (i + 0.5) / kCellsBetween;
    const int knot = std::min(static_cast<int>(at), kKnots - 2);
    const double share = at - knot;
    light[i + 1] =
        light[i] + SrgbSteps()[i] * exp(slopes[knot] * (1 - share) + slopes[knot + 1] * share);
  }
  const Number whole = light[kCells];
  for (Number& border : light) border /= whole;
  return light;
}

// Beyond the ends it goes on as in the last cell.
template <typename Number>
Number CodeOf(const Borders<Number>& borders, const Number& light) {
  const auto above = std::upper_bound(borders.begin() + 1, borders.end() - 1, light);
  const auto cell = above - borders.begin() - 1;
  return (Number(static_cast<double>(cell)) +
          (light - borders[cell]) / (borders[cell + 1] - borders[cell])) /
         double(kCells);
}

// d ln light / d code, evened over a few cells.
double SlopeAt(const Borders<double>& borders, double code) {
  const int cell = std::clamp(static_cast<int>(code * kCells), 0, kCells - 1);
  const int low = std::max(cell - kSlopeCells, 0), high = std::min(cell + kSlopeCells + 1, kCells);
  const double ratio =
      borders[high] / std::max(borders[low], std::min(kFaintestLight, borders[high] / 2));
  return std::log(ratio) * kCells / (high - low);
}

// Of one channel: what is unknown.
struct Unknowns {
  std::array<double, kKnots> slopes = {};
  std::array<double, 2> light = {};  // ln of sun and sky
  std::vector<double> materials;     // ln of their reflectances
  std::vector<double> surfaces;      // ln, beyond their materials'
};

// What the residuals are multiplied with: from the round before.
struct Weighing {
  std::vector<double> slopes, weights;  // of the samples
  double sky_slope = 1;
};

// All residuals of one channel, since they share the curve.
class ChannelResiduals {
 public:
  ChannelResiduals(const std::vector<ResponseSample>& samples, int channel,
                   const ResponseFitOptions& options, const Weighing& weighing)
      : samples_(samples), channel_(channel), options_(options), weighing_(weighing) {}

  int CountOf(const Unknowns& unknowns) const {
    return static_cast<int>(samples_.size() + unknowns.surfaces.size()) + kKnots + 2;
  }

  template <typename Number>
  bool operator()(Number const* const* parameters, Number* residuals) const {
    const Number *slopes = parameters[0], *light = parameters[1], *materials = parameters[2],
                 *surfaces = parameters[3];
    const Borders<Number> borders = LightAtBorders(slopes);
    const Number sun = exp(light[0]), sky = exp(light[1]);
    for (size_t i = 0; i < samples_.size(); ++i) {
      const ResponseSample& sample = samples_[i];
      const Number irradiance = sun * sample.sun + sky * sample.sky + sample.surroundings[channel_];
      const Number rho = exp(materials[sample.material] + surfaces[sample.surface]);
      const Number apparent =
          rho * irradiance * (sample.through[channel_] / std::numbers::pi) + sample.added[channel_];
      residuals[i] = (sample.code[channel_] - CodeOf(borders, apparent)) *
                     (weighing_.slopes[i] * weighing_.weights[i] / options_.sigma);
    }
    Number* next = residuals + samples_.size();
    for (int k = 0; k + 1 < kKnots; ++k) {
      *next++ = (slopes[k + 1] - slopes[k]) / options_.slope_sigma;
    }
    *next++ = slopes[kKnots / 2] / kMiddleSigma;
    *next++ = (materials[0] - std::log(options_.reflectance[channel_])) / kKnownSigma;
    *next++ = options_.sky_code ? ((*options_.sky_code)[channel_] - CodeOf(borders, sky)) *
                                      (weighing_.sky_slope / options_.sky_sigma)
                                : Number(0);
    for (Number* const end = residuals + count_; next < end; ++next) {
      *next = surfaces[next - (end - surfaces_)] / options_.surface_sigma;
    }
    return true;
  }

  void SetUnknowns(const Unknowns& unknowns) {
    count_ = CountOf(unknowns);
    surfaces_ = static_cast<int>(unknowns.surfaces.size());
  }

 private:
  const std::vector<ResponseSample>& samples_;
  const int channel_;
  const ResponseFitOptions& options_;
  const Weighing& weighing_;
  int count_ = 0, surfaces_ = 0;
};

int CountOf(const std::vector<ResponseSample>& samples, int ResponseSample::*member) {
  return 1 + (*std::ranges::max_element(samples, {}, member)).*member;
}

// By sRGB's curve: the middle one of what its places have.
std::vector<double> FirstReflectances(const std::vector<ResponseSample>& samples, int channel,
                                      const ResponseFitOptions& options) {
  std::vector<std::vector<double>> all(CountOf(samples, &ResponseSample::material));
  for (const ResponseSample& sample : samples) {
    const double irradiance = options.sun[channel] * sample.sun +
                              options.sky[channel] * sample.sky + sample.surroundings[channel];
    const double light =
        (LinearFromSrgb(sample.code[channel]) - sample.added[channel]) / sample.through[channel];
    all[sample.material].push_back(
        std::log(std::max(light, 1e-3) * std::numbers::pi / std::max(irradiance, 1e-6)));
  }
  std::vector<double> middle;
  for (std::vector<double>& of_material : all) middle.push_back(Median(std::move(of_material)));
  return middle;
}

class ChannelFit {
 public:
  ChannelFit(const std::vector<ResponseSample>& samples, int channel,
             const ResponseFitOptions& options)
      : samples_(samples), channel_(channel), options_(options) {
    unknowns_.light = {std::log(options.sun[channel]), std::log(options.sky[channel])};
    unknowns_.materials = FirstReflectances(samples, channel, options);
    unknowns_.surfaces.assign(CountOf(samples, &ResponseSample::surface), 0);
    weighing_.weights.assign(samples.size(), 1);
    weighing_.slopes.assign(samples.size(), 1);
    AddResiduals();
  }

  void Solve() {
    ceres::Solver::Options how;
    how.max_num_iterations = 15;
    how.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    how.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    for (int round = 0; round < kRounds; ++round) {
      Weigh(round);
      ceres::Solve(how, &problem_, &summary);
    }
    over_sigma_ = OverSigma();
  }

  ResponsePoints Points() const {
    const Borders<double> borders = LightAtBorders(unknowns_.slopes.data());
    ResponsePoints points;
    for (int i = 0; i <= kCells; ++i) points.emplace_back(double(i) / kCells, borders[i]);
    return points;
  }
  double SunOverSky() const { return std::exp(unknowns_.light[0] - unknowns_.light[1]); }
  double SquaresThatCount() const {
    double sum = 0;
    for (size_t i = 0; i < over_sigma_.size(); ++i) {
      if (weighing_.weights[i] > 0) sum += over_sigma_[i] * over_sigma_[i];
    }
    return sum;
  }
  double CountThatCount() const {
    return static_cast<double>(
        std::ranges::count_if(weighing_.weights, [](double weight) { return weight > 0; }));
  }
  // Of the logarithm of SunOverSky; infinite where the light is not determined.
  double Sigma() {
    ceres::Covariance::Options how;
    how.algorithm_type = ceres::DENSE_SVD;
    how.null_space_rank = -1;
    ceres::Covariance covariance(how);
    const std::vector<std::pair<const double*, const double*>> of_light = {
        {unknowns_.light.data(), unknowns_.light.data()}};
    if (!covariance.Compute(of_light, &problem_)) return INFINITY;
    std::array<double, 4> light = {};
    covariance.GetCovarianceBlock(unknowns_.light.data(), unknowns_.light.data(), light.data());
    return std::sqrt(std::max(0.0, light[0] + light[3] - 2 * light[1]));
  }

 private:
  void AddResiduals() {
    auto residuals = std::make_unique<ChannelResiduals>(samples_, channel_, options_, weighing_);
    residuals->SetUnknowns(unknowns_);
    const int count = residuals->CountOf(unknowns_);
    auto* cost = new ceres::DynamicAutoDiffCostFunction<ChannelResiduals, 16>(residuals.release());
    cost->AddParameterBlock(kKnots);
    cost->AddParameterBlock(2);
    cost->AddParameterBlock(static_cast<int>(unknowns_.materials.size()));
    cost->AddParameterBlock(static_cast<int>(unknowns_.surfaces.size()));
    cost->SetNumResiduals(count);
    problem_.AddResidualBlock(cost, nullptr, unknowns_.slopes.data(), unknowns_.light.data(),
                              unknowns_.materials.data(), unknowns_.surfaces.data());
  }

  // Residuals of the samples, unweighted.
  std::vector<double> OverSigma() {
    std::vector<double> all;
    const std::vector<double> weights =
        std::exchange(weighing_.weights, std::vector<double>(samples_.size(), 1));
    problem_.Evaluate({}, nullptr, &all, nullptr, nullptr);
    weighing_.weights = weights;
    all.resize(samples_.size());
    return all;
  }

  void Weigh(int round) {
    const Borders<double> borders = LightAtBorders(unknowns_.slopes.data());
    for (size_t i = 0; i < samples_.size(); ++i) {
      weighing_.slopes[i] = SlopeAt(borders, samples_[i].code[channel_]);
    }
    if (options_.sky_code) weighing_.sky_slope = SlopeAt(borders, (*options_.sky_code)[channel_]);
    const std::vector<double> residuals = OverSigma();
    std::vector<double> sizes;
    for (const double residual : residuals) sizes.push_back(std::abs(residual));
    const double scale = std::max(1.0, kSigmaOverMedian * Median(std::move(sizes)));
    const double wide = std::max(1.0, kWide * (1 - double(round) / kWideRounds));
    const double end = kTukey * wide * scale;
    for (size_t i = 0; i < samples_.size(); ++i) {
      const double t = residuals[i] / end;
      weighing_.weights[i] = std::abs(t) < 1 ? 1 - t * t : 0;
    }
  }

  const std::vector<ResponseSample>& samples_;
  const int channel_;
  const ResponseFitOptions& options_;
  Weighing weighing_;
  Unknowns unknowns_;
  std::vector<double> over_sigma_;
  ceres::Problem problem_;
};

}  // namespace

ResponseFit FitResponse(const std::vector<ResponseSample>& samples,
                        const ResponseFitOptions& options) {
  INSITU_CHECK(std::ranges::count(samples, 0, &ResponseSample::material) >= 3);
  INSITU_CHECK(options.sun.minCoeff() > 0 && options.sky.minCoeff() > 0);
  ResponseFit fit;
  double squares = 0, count = 0;
  for (int c = 0; c < 3; ++c) {
    ChannelFit channel(samples, c, options);
    channel.Solve();
    fit.curves[c] = channel.Points();
    fit.sun_over_sky[c] = channel.SunOverSky();
    fit.sun_over_sky_sigma[c] = channel.Sigma();
    squares += channel.SquaresThatCount();
    count += channel.CountThatCount();
  }
  fit.rms = std::sqrt(squares / std::max(1.0, count));
  fit.share = count / static_cast<double>(3 * samples.size());
  return fit;
}

}  // namespace insitu
