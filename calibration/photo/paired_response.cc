// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/paired_response.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "calibration/algebra/decompositions.h"

namespace insitu {
namespace {

constexpr int kPieceSide = 64, kPiecesAcross = 14;  // [px]; along the longer side
constexpr int kCoarseSide = 512;                    // [px], longer side of what is matched first
constexpr int kFewestPieces = 12, kFineRounds = 4;
constexpr double kClearPeak = 0.15;  // of the phase correlation, at most 1
constexpr double kFarOff = 3;        // times the middle residual: another thing was found
constexpr double kDark = 0.01;       // added to light before its logarithm
constexpr int kPlacesAcross = 240, kEvenReach = 2;
constexpr size_t kFewestPlaces = 100;
constexpr double kEvenShare = 0.08;  // brightest over darkest of an even place, beyond 1
constexpr double kDarkestCode = 0.02, kBrightestCode = 0.98, kBrightestRaw = 0.95;
constexpr int kBins = 64, kTurns = 10;

const Eigen::Vector3d kLuminance(0.2126, 0.7152, 0.0722);

Eigen::Vector2d Middle(const Raster& image) {
  return {(image.width - 1) / 2.0, (image.height - 1) / 2.0};
}

Eigen::Vector2d InRaw(const PairRegistration& pair, const Raster& raw, const Raster& picture,
                      const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d from_middle = pixel - Middle(picture);
  const double r2 = from_middle.squaredNorm() / Middle(picture).squaredNorm();
  return Middle(raw) + pair.shift + pair.scale * (1 + pair.radial * r2) * from_middle;
}

bool IsInside(const Raster& image, const Eigen::Vector2d& pixel) {
  return pixel.minCoeff() >= 0 && pixel.x() <= image.width - 1 && pixel.y() <= image.height - 1;
}

float LogLight(const Raster& image, const Eigen::Vector2d& pixel) {
  const double light = kLuminance.dot(Interpolate(image, pixel));
  return static_cast<float>(std::log(std::max(light, 0.0) + kDark));
}

// How far what `b` shows is moved against `a`, and how clear that is.
struct Move {
  Eigen::Vector2d by = Eigen::Vector2d::Zero();  // [px]
  double peak = 0;
};

Move MoveOf(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat window;
  cv::createHanningWindow(window, a.size(), CV_32F);
  Move move;
  const cv::Mat from = a - cv::mean(a)[0], to = b - cv::mean(b)[0];
  const cv::Point2d by = cv::phaseCorrelate(from, to, window, &move.peak);
  move.by = {by.x, by.y};
  return move;
}

// The whole frame, coarsely.
void FindShift(const Raster& raw, const Raster& picture, PairRegistration* pair) {
  const double step = std::max(1.0, std::max(picture.width, picture.height) / double(kCoarseSide));
  const cv::Size size(int(picture.width / step), int(picture.height / step));
  cv::Mat a(size, CV_32F), b(size, CV_32F);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector2d pixel = step * Eigen::Vector2d(x, y);
      a.at<float>(y, x) = LogLight(picture, pixel);
      b.at<float>(y, x) = LogLight(raw, InRaw(*pair, raw, picture, pixel));
    }
  }
  pair->shift += MoveOf(a, b).by * step * pair->scale;
}

struct Piece {
  Eigen::Vector2d pixel;  // of the picture, its middle
  Eigen::Vector2d off;    // [px] of the raw, from where it was expected
};

std::vector<Piece> FindPieces(const Raster& raw, const Raster& picture,
                              const PairRegistration& pair) {
  std::vector<Piece> pieces;
  const int step =
      std::max(kPieceSide / 2, std::max(picture.width, picture.height) / kPiecesAcross);
  cv::Mat a(kPieceSide, kPieceSide, CV_32F), b = a.clone();
  for (int top = 0; top + kPieceSide <= picture.height; top += step) {
    for (int left = 0; left + kPieceSide <= picture.width; left += step) {
      for (int y = 0; y < kPieceSide; ++y) {
        for (int x = 0; x < kPieceSide; ++x) {
          const Eigen::Vector2d pixel(left + x, top + y);
          a.at<float>(y, x) = LogLight(picture, pixel);
          b.at<float>(y, x) = LogLight(raw, InRaw(pair, raw, picture, pixel));
        }
      }
      const Move move = MoveOf(a, b);
      if (move.peak < kClearPeak) continue;
      const Eigen::Vector2d middle =
          Eigen::Vector2d(left, top) + Eigen::Vector2d::Constant((kPieceSide - 1) / 2.0);
      pieces.push_back({middle, pair.scale * move.by});
    }
  }
  return pieces;
}

// Least squares of the pieces that are not far off; twice, for the middle residual tells which.
void Improve(const Raster& picture, const std::vector<Piece>& pieces, PairRegistration* pair) {
  const Eigen::Vector2d middle = Middle(picture);
  Eigen::Vector4d change = Eigen::Vector4d::Zero();
  std::vector<double> squares(pieces.size(), 0);
  double limit = INFINITY;
  for (int pass = 0; pass < 3; ++pass) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    const auto row = [&](const Piece& piece, int axis) {
      const Eigen::Vector2d from_middle = piece.pixel - middle;
      const double r2 = from_middle.squaredNorm() / middle.squaredNorm();
      return Eigen::Vector4d(axis == 0, axis == 1, from_middle[axis],
                             pair->scale * r2 * from_middle[axis]);
    };
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < pieces.size(); ++i) {
      if (squares[i] > limit) continue;
      sum += squares[i];
      ++count;
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector4d a = row(pieces[i], axis);
        normal += a * a.transpose();
        right += a * pieces[i].off[axis];
      }
    }
    pair->pieces = count;
    pair->residual_px = std::sqrt(sum / std::max(1, count));
    if (pass == 2) break;
    change = SolveSymmetric(normal, right);
    for (size_t i = 0; i < pieces.size(); ++i) {
      squares[i] = std::pow(row(pieces[i], 0).dot(change) - pieces[i].off.x(), 2) +
                   std::pow(row(pieces[i], 1).dot(change) - pieces[i].off.y(), 2);
    }
    std::vector<double> sorted = squares;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    limit = kFarOff * kFarOff * std::max(sorted[sorted.size() / 2], 1e-6);
  }
  pair->shift += change.head<2>();
  pair->scale += change[2];
  pair->radial += change[3];
}

// ---- curves and matrix ----------------------------------------------------------------------

struct PairPlace {
  Eigen::Vector3d code, light;  // of the picture, as sRGB; of the raw
};

// The mean about a pixel; nullopt: uneven.
std::optional<Eigen::Vector3d> EvenMean(const Raster& image, const Eigen::Vector2d& at) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double low = INFINITY, high = 0;
  for (int v = -kEvenReach; v <= kEvenReach; ++v) {
    for (int u = -kEvenReach; u <= kEvenReach; ++u) {
      const Eigen::Vector3d rgb = Interpolate(image, at + Eigen::Vector2d(u, v));
      const double light = kLuminance.dot(rgb);
      low = std::min(low, light);
      high = std::max(high, light);
      sum += rgb;
    }
  }
  if (low <= 0 || high > (1 + kEvenShare) * low) return std::nullopt;
  return sum / std::pow(2 * kEvenReach + 1, 2);
}

std::vector<PairPlace> FindPlaces(const Raster& raw, const Raster& picture,
                                  const PairRegistration& pair) {
  std::vector<PairPlace> places;
  const int step = std::max(1, std::max(picture.width, picture.height) / kPlacesAcross);
  for (int y = kEvenReach; y < picture.height - kEvenReach; y += step) {
    for (int x = kEvenReach; x < picture.width - kEvenReach; x += step) {
      const Eigen::Vector2d in_raw = InRaw(pair, raw, picture, {x, y});
      if (!IsInside(raw, in_raw)) continue;
      const auto shown = EvenMean(picture, {x, y}), light = EvenMean(raw, in_raw);
      if (!shown || !light || light->maxCoeff() > kBrightestRaw) continue;
      const Eigen::Vector3d code = shown->unaryExpr(&SrgbFromLinear);
      if (code.minCoeff() < kDarkestCode || code.maxCoeff() > kBrightestCode) continue;
      places.push_back({code, *light});
    }
  }
  return places;
}

// The bin of a code, and the code in its middle.
int BinOf(double code) { return std::clamp(static_cast<int>(code * kBins), 0, kBins - 1); }
double MiddleOf(int bin) { return (bin + 0.5) / kBins; }

// ln of light over sRGB's by bin, between bins that have some; beyond them it stays.
std::vector<double> Filled(const std::vector<double>& sums, const std::vector<double>& counts) {
  std::vector<int> known;
  for (int i = 0; i < kBins; ++i) {
    if (counts[i] > 0) known.push_back(i);
  }
  std::vector<double> values(kBins);
  for (int i = 0; i < kBins; ++i) {
    const auto above = std::ranges::lower_bound(known, i);
    const int high = above == known.end() ? known.back() : *above;
    const int low = above == known.begin() || *(above - 1) > i ? high : *(above - 1);
    const double share = high > low ? std::clamp((i - low) / double(high - low), 0.0, 1.0) : 0;
    values[i] = (1 - share) * sums[low] / counts[low] + share * sums[high] / counts[high];
  }
  return values;
}

// A rising curve through the means of light over codes; the last light is 1.
ResponsePoints CurveThrough(const std::vector<PairPlace>& places, const std::vector<double>& light,
                            int channel) {
  std::vector<double> sums(kBins), counts(kBins);
  for (size_t i = 0; i < places.size(); ++i) {
    if (light[i] <= 0) continue;
    const double code = places[i].code[channel];
    sums[BinOf(code)] += std::log(light[i] / LinearFromSrgb(code));
    ++counts[BinOf(code)];
  }
  const std::vector<double> over_srgb = Filled(sums, counts);
  ResponsePoints points = {{0, 0}};
  for (int i = 0; i < kBins; ++i) {
    const double value = std::exp(over_srgb[i]) * LinearFromSrgb(MiddleOf(i));
    points.emplace_back(MiddleOf(i), std::max(value, points.back().second * (1 + 1e-6) + 1e-9));
  }
  points.emplace_back(1, std::max(std::exp(over_srgb.back()), points.back().second * (1 + 1e-6)));
  const double whole = points.back().second;
  for (auto& [code, value] : points) value /= whole;
  return points;
}

Eigen::Vector3d Through(const std::array<ToneCurve, 3>& curves, const Eigen::Vector3d& code) {
  return {curves[0].Linear(code[0]), curves[1].Linear(code[1]), curves[2].Linear(code[2])};
}

// Weighted by the light, for errors are shares of it.
Eigen::Matrix3d MatrixOf(const std::vector<PairPlace>& places,
                         const std::array<ToneCurve, 3>& curves) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(), right = Eigen::Matrix3d::Zero();
  for (const PairPlace& place : places) {
    const double weight = 1 / std::pow(kLuminance.dot(place.light), 2);
    const Eigen::Vector3d shown = Through(curves, place.code);
    normal += weight * shown * shown.transpose();
    right += weight * place.light * shown.transpose();
  }
  return right * InverseOfSymmetric(normal);
}

std::array<ToneCurve, 3> CurvesOf(const std::array<ResponsePoints, 3>& points) {
  return {ResponseCurve(points[0]), ResponseCurve(points[1]), ResponseCurve(points[2])};
}

double SigmaOf(const std::vector<PairPlace>& places, const PairedResponse& response) {
  const std::array<ToneCurve, 3> curves = CurvesOf(response.curves);
  double squares = 0;
  for (const PairPlace& place : places) {
    const double light = kLuminance.dot(place.light);
    const double found = kLuminance.dot(response.rec709 * Through(curves, place.code));
    squares += std::pow(found / light - 1, 2);
  }
  return std::sqrt(squares / static_cast<double>(places.size()));
}

}  // namespace

PairRegistration RegisterPair(const Raster& raw, const Raster& picture) {
  PairRegistration pair;
  const double by_width = double(raw.width) / picture.width;
  // A camera crops a few pixels, or makes its pictures smaller by far more.
  constexpr double kSmaller = 1.1;
  pair.scale = by_width < kSmaller ? 1 : by_width;
  FindShift(raw, picture, &pair);
  for (int round = 0; round < kFineRounds; ++round) {
    const std::vector<Piece> pieces = FindPieces(raw, picture, pair);
    if (static_cast<int>(pieces.size()) < kFewestPieces) {
      pair.pieces = 0;
      return pair;
    }
    Improve(picture, pieces, &pair);
  }
  return pair;
}

std::optional<PairedResponse> FitPairedResponse(const Raster& raw, const Raster& picture,
                                                const PairRegistration& registration) {
  const std::vector<PairPlace> places = FindPlaces(raw, picture, registration);
  if (places.size() < kFewestPlaces) return std::nullopt;
  PairedResponse response;
  response.places = static_cast<int>(places.size());
  for (int turn = 0; turn < kTurns; ++turn) {
    const Eigen::Matrix3d shown_from_raw = response.rec709.inverse();
    for (int c = 0; c < 3; ++c) {
      std::vector<double> light;
      for (const PairPlace& place : places) light.push_back(shown_from_raw.row(c) * place.light);
      response.curves[c] = CurveThrough(places, light, c);
    }
    response.rec709 = MatrixOf(places, CurvesOf(response.curves));
  }
  response.sigma = SigmaOf(places, response);
  return response;
}

}  // namespace insitu
