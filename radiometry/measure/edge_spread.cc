// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/edge_spread.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "calibration/algebra/decompositions.h"

namespace insitu {
namespace {

constexpr double kShortest = 32, kLongest = 128;  // [px], of a piece
constexpr double kPhases = 1.2;          // [px] across the rows or columns, more than one pixel
constexpr double kLeastContrast = 0.05;  // of the photographs' white
constexpr double kMostUneven = 0.05;     // rms of the residuals over the contrast
constexpr double kMostOffset = 2;        // [px], survey and orientation together
constexpr double kMostError = 0.2;       // of sigma, relative
constexpr double kPlateau = 3;           // [px] from the edge, where its sides are taken to start
constexpr double kMostContrast = 1.3;    // fitted over that between the plateaus: else no edge
constexpr double kLeastSigma = 0.1, kMostSigma = 2;  // [px], what a window this wide can tell
constexpr int kIterations = 40;

struct EdgePixel {
  double across, along;  // [px], from the edge and from the middle of the piece
  double luminance;
};

// Offset, tilt, log sigma, level at the edge's foot, contrast, slopes before and behind.
using EdgeModel = Eigen::Matrix<double, 7, 1>;

struct EdgeFit {
  EdgeModel model;
  double rms = 0;
  double log_sigma_error = 0;
};

double Luminance(const Eigen::Vector3d& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// The pixels about a piece; none where one is clipped or the frame ends.
std::vector<EdgePixel> CollectPixels(const Photograph& photo, const EdgePiece& piece) {
  const Eigen::Vector2d chord = piece[2] - piece[0], middle = (piece[0] + piece[2]) / 2;
  const double half = chord.norm() / 2;
  const Eigen::Vector2d along = chord.normalized(), across(-along.y(), along.x());
  const double bend = across.dot(piece[1] - middle);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kEdgeReach + 1);
  const Eigen::Vector2i low = (piece[0].cwiseMin(piece[2]) - margin).array().floor().cast<int>();
  const Eigen::Vector2i high = (piece[0].cwiseMax(piece[2]) + margin).array().ceil().cast<int>();
  const Raster& image = photo.linear;
  if (low.minCoeff() < 0 || high.x() >= image.width || high.y() >= image.height) return {};
  std::vector<EdgePixel> pixels;
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const Eigen::Vector2d from_middle = Eigen::Vector2d(x, y) - middle;
      const double s = along.dot(from_middle) / half;
      const double u = across.dot(from_middle) - bend * (1 - s * s);
      if (std::abs(s) > 1 || std::abs(u) > kEdgeReach) continue;
      if (IsClipped(photo, x, y)) return {};
      pixels.push_back({u, s * half, Luminance(image.Rgb(x, y))});
    }
  }
  return pixels;
}

double NormalIntegral(double t) { return 0.5 * std::erfc(-t / std::numbers::sqrt2); }

// The model's luminance at a pixel and its derivatives by the model's parameters.
double Predict(const EdgeModel& model, const EdgePixel& pixel, EdgeModel* gradient) {
  const double from_edge = pixel.across - model[0] - model[1] * pixel.along;
  const double sigma = std::exp(model[2]), t = from_edge / sigma;
  const double density = std::exp(-t * t / 2) / (std::sqrt(2 * std::numbers::pi) * sigma);
  const double share = NormalIntegral(t);
  const double slope = from_edge < 0 ? model[5] : model[6];
  const double by_offset = -model[4] * density - slope;
  *gradient << by_offset, by_offset * pixel.along, -model[4] * density * from_edge, 1, share,
      std::min(from_edge, 0.0), std::max(from_edge, 0.0);
  return model[3] + model[4] * share + slope * from_edge;
}

// Mean luminance beyond kPlateau before (-1) or behind (1) the edge.
double SideLevel(const std::vector<EdgePixel>& pixels, double side) {
  double sum = 0;
  int count = 0;
  for (const EdgePixel& pixel : pixels) {
    if (side * pixel.across < kPlateau) continue;
    sum += pixel.luminance;
    ++count;
  }
  return sum / std::max(count, 1);
}

// As ceres::TinySolver asks for them.
struct EdgeResiduals {
  using Scalar = double;
  static constexpr int NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 7;
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 7>;

  const std::vector<EdgePixel>& pixels;

  int NumResiduals() const { return static_cast<int>(pixels.size()); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const EdgeModel model = Eigen::Map<const EdgeModel>(parameters);
    for (int i = 0; i < NumResiduals(); ++i) {
      EdgeModel gradient;
      residuals[i] = Predict(model, pixels[i], &gradient) - pixels[i].luminance;
      if (jacobian) Eigen::Map<Jacobian>(jacobian, NumResiduals(), 7).row(i) = gradient;
    }
    return true;
  }
};

// As ceres::TinySolver asks for one.
struct NormalEquations {
  Eigen::MatrixXd matrix;

  void compute(const Eigen::MatrixXd& normal) { matrix = normal; }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const {
    return SolveSymmetric(matrix, right);
  }
};

// From the expected place.
EdgeFit FitEdge(const std::vector<EdgePixel>& pixels, double before, double behind) {
  EdgeModel model;
  model << 0, 0, std::log(0.5), before, behind - before, 0, 0;
  const EdgeResiduals problem{pixels};
  ceres::TinySolver<EdgeResiduals, NormalEquations> solver;
  solver.options.max_num_iterations = kIterations;
  solver.Solve(problem, &model);
  Eigen::VectorXd residuals(problem.NumResiduals());
  EdgeResiduals::Jacobian jacobian(problem.NumResiduals(), 7);
  problem(model.data(), residuals.data(), jacobian.data());
  const double variance = residuals.squaredNorm() / static_cast<double>(pixels.size() - 7);
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const double cofactor = InverseOfSymmetric(normal)(2, 2);
  return {model, std::sqrt(variance), std::sqrt(variance * std::max(cofactor, 0.0))};
}

bool IsPlausible(const EdgeFit& fit, double contrast, double half_length) {
  const double fitted = std::abs(fit.model[4]), sigma = std::exp(fit.model[2]);
  const double offset = std::abs(fit.model[0]) + half_length * std::abs(fit.model[1]);
  return fitted > kLeastContrast && fitted < kMostContrast * contrast &&
         fit.rms < kMostUneven * fitted && offset < kMostOffset && sigma > kLeastSigma &&
         sigma < kMostSigma && fit.log_sigma_error < kMostError;
}

}  // namespace

std::optional<double> SlantedLength(const Eigen::Vector2d& unit) {
  const double slant = unit.cwiseAbs().minCoeff();
  if (slant * kLongest < kPhases) return std::nullopt;
  return std::max(kShortest, kPhases / slant);
}

std::optional<EdgeSpread> MeasureEdgeSpread(const Photograph& photo, const EdgePiece& piece) {
  const Eigen::Vector2d chord = piece[2] - piece[0];
  const auto least = SlantedLength(chord.normalized());
  if (!least || chord.norm() < 0.99 * *least) return std::nullopt;
  const std::vector<EdgePixel> pixels = CollectPixels(photo, piece);
  if (pixels.empty()) return std::nullopt;
  const double before = SideLevel(pixels, -1), behind = SideLevel(pixels, 1);
  const double contrast = std::abs(behind - before);
  if (contrast < kLeastContrast) return std::nullopt;
  const EdgeFit fit = FitEdge(pixels, before, behind);
  if (!IsPlausible(fit, contrast, chord.norm() / 2)) return std::nullopt;
  const double sigma = std::exp(fit.model[2]);
  return EdgeSpread{sigma, sigma * fit.log_sigma_error};
}

}  // namespace insitu
