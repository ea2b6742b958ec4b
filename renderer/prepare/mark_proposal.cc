// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/mark_proposal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "calibration/algebra/decompositions.h"

namespace insitu {
namespace {

constexpr int kHalfWindow = 3;           // [px], larger ones are drawn to other edges
constexpr double kFarthestShift = 2.5;   // [px]
constexpr double kLeastSigma = 0.3;      // [px]
constexpr double kWeakCorner = 0.05;     // smaller over larger eigenvalue of the gradients
constexpr double kEvenSurface = 25;      // [codes^2], mean squared gradient along the weaker axis
constexpr int kHalfPattern = 10;         // [px]
constexpr int kSymmetricShift = 4;       // [px]
constexpr double kSymmetricSigma = 0.1;  // [px], of sharp crosses
constexpr double kLeastBend = 0.01;      // of the symmetry's peak across half a pixel
constexpr double kLeastMatch = 0.8;
constexpr double kSecondBest = 0.9;  // of the best, where two places look alike
constexpr int kApart = 3;            // [px], peaks closer than this are one

// Mean of the gradients' products over the window about the patch's middle.
Eigen::Matrix2d StructureTensor(const cv::Mat& grey, const cv::Point2f& at) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  const int x = cvRound(at.x), y = cvRound(at.y);
  int count = 0;
  for (int v = y - kHalfWindow; v <= y + kHalfWindow; ++v) {
    for (int u = x - kHalfWindow; u <= x + kHalfWindow; ++u) {
      if (u < 1 || v < 1 || u + 1 >= grey.cols || v + 1 >= grey.rows) continue;
      const Eigen::Vector2d g((grey.at<uchar>(v, u + 1) - grey.at<uchar>(v, u - 1)) / 2.0,
                              (grey.at<uchar>(v + 1, u) - grey.at<uchar>(v - 1, u)) / 2.0);
      sum += g * g.transpose();
      ++count;
    }
  }
  return sum / std::max(1, count);
}

Eigen::Vector2d ToPatch(const GreyPatch& patch, const Eigen::Vector2d& pixel) {
  return pixel - patch.center.cast<double>() +
         Eigen::Vector2d(patch.grey.cols / 2, patch.grey.rows / 2);
}

// The pattern about `pixel` as the other photo would show it.
cv::Mat WarpedPattern(const GreyPatch& patch, const Eigen::Vector2d& pixel,
                      const Eigen::Matrix2d& other_from_photo) {
  const Eigen::Matrix2d photo_from_other = other_from_photo.inverse();
  const Eigen::Vector2d middle = ToPatch(patch, pixel);
  const Eigen::Vector2d shift =
      middle - photo_from_other * Eigen::Vector2d(kHalfPattern, kHalfPattern);
  const cv::Matx23d map(photo_from_other(0, 0), photo_from_other(0, 1), shift.x(),
                        photo_from_other(1, 0), photo_from_other(1, 1), shift.y());
  cv::Mat pattern;
  cv::warpAffine(patch.grey, pattern, map, {2 * kHalfPattern + 1, 2 * kHalfPattern + 1},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return pattern;
}

// The top of the parabola through three values at -1, 0, 1.
double ParabolaTop(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0;
}

// How alike the surroundings of a place are to themselves turned about it by 180 degrees, -1..1;
// `twice` the place, since places between two pixels count too. Nothing: an even surface, the edge.
std::optional<double> SymmetryAbout(const cv::Mat& grey, const cv::Point& twice) {
  const cv::Rect frame(0, 0, grey.cols, grey.rows);
  const int left = (twice.x + 1) / 2 - kHalfPattern, right = twice.x - left;
  const int top = (twice.y + 1) / 2 - kHalfPattern, bottom = twice.y - top;
  if (!frame.contains({left, top}) || !frame.contains({right, bottom})) return std::nullopt;
  double sum = 0, squares = 0, products = 0;
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const double value = grey.at<uchar>(v, u);
      sum += value;
      squares += value * value;
      products += value * grey.at<uchar>(twice.y - v, twice.x - u);
    }
  }
  const double count = (right - left + 1) * (bottom - top + 1), mean = sum / count;
  const double variance = squares / count - mean * mean;
  if (variance < kEvenSurface) return std::nullopt;
  return (products / count - mean * mean) / variance;
}

double SecondPeak(const cv::Mat& scores, const cv::Point& best) {
  double second = -1;
  for (int v = 0; v < scores.rows; ++v) {
    for (int u = 0; u < scores.cols; ++u) {
      if (std::abs(u - best.x) < kApart && std::abs(v - best.y) < kApart) continue;
      second = std::max(second, static_cast<double>(scores.at<float>(v, u)));
    }
  }
  return second;
}

}  // namespace

std::variant<MarkProposal, NoProposal> RefineCorner(const GreyPatch& patch,
                                                    const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d start = ToPatch(patch, pixel);
  std::vector<cv::Point2f> corner = {
      {static_cast<float>(start.x()), static_cast<float>(start.y())}};
  const Eigen::Vector2d gradients =
      EigenOfSymmetric<2>(StructureTensor(patch.grey, corner[0])).values;
  const double weak = gradients[0], strong = gradients[1];
  if (strong < kEvenSurface) return Sentence("markEven", "an even surface");
  if (weak < kEvenSurface) return Sentence("markEdge", "an edge, no corner");
  if (weak < kWeakCorner * strong) return Sentence("markEdge", "an edge, no corner");
  cv::cornerSubPix(patch.grey, corner, {kHalfWindow, kHalfWindow}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.005});
  MarkProposal proposal;
  const Eigen::Vector2d shift = Eigen::Vector2d(corner[0].x, corner[0].y) - start;
  proposal.pixel = pixel + shift;
  proposal.shift_px = shift.norm();
  if (!(proposal.shift_px <= kFarthestShift)) return Sentence("markFar", "no corner within 2.5 px");
  proposal.quality = weak / strong;
  proposal.sigma_px = std::max(kLeastSigma, 0.5 * std::sqrt(kWeakCorner / proposal.quality));
  return proposal;
}

std::variant<MarkProposal, NoProposal> RefineSymmetric(const GreyPatch& patch,
                                                       const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d start = ToPatch(patch, pixel);
  const cv::Point middle(cvRound(2 * start.x()), cvRound(2 * start.y()));
  cv::Mat scores(4 * kSymmetricShift + 1, 4 * kSymmetricShift + 1, CV_32F);
  for (int v = 0; v < scores.rows; ++v) {
    for (int u = 0; u < scores.cols; ++u) {
      const cv::Point shift(u - 2 * kSymmetricShift, v - 2 * kSymmetricShift);
      const auto score = SymmetryAbout(patch.grey, middle + shift);
      if (!score) return Sentence("markEvenOrEdge", "an even surface, or too near the edge");
      scores.at<float>(v, u) = static_cast<float>(*score);
    }
  }
  double score = 0;
  cv::Point best;
  cv::minMaxLoc(scores, nullptr, &score, nullptr, &best);
  const cv::Rect inner(1, 1, scores.cols - 2, scores.rows - 2);
  const Sentence no_centre("markNoCentre", "no centre of a mark within 4 px, or a line");
  if (score < kLeastMatch || !inner.contains(best)) return no_centre;
  const auto at = [&](int u, int v) { return scores.at<float>(best.y + v, best.x + u); };
  const double bend = std::max(at(-1, 0) + at(1, 0), at(0, -1) + at(0, 1)) - 2 * at(0, 0);
  if (bend > -kLeastBend) return no_centre;
  const Eigen::Vector2d found(best.x + middle.x + ParabolaTop(at(-1, 0), at(0, 0), at(1, 0)),
                              best.y + middle.y + ParabolaTop(at(0, -1), at(0, 0), at(0, 1)));
  const Eigen::Vector2d shift = found / 2 - Eigen::Vector2d::Constant(kSymmetricShift) - start;
  return MarkProposal{pixel + shift, kSymmetricSigma, score, shift.norm()};
}

std::variant<MarkProposal, NoProposal> MatchPatch(
    const GreyPatch& patch, const Eigen::Vector2d& pixel, const GreyPatch& other,
    const Eigen::Vector2d& predicted, const Eigen::Matrix2d& other_from_photo, double radius) {
  if (std::abs(other_from_photo.determinant()) < 0.04)
    return Sentence("matchOblique", "seen too obliquely there");
  const cv::Mat pattern = WarpedPattern(patch, pixel, other_from_photo);
  const Eigen::Vector2i middle = ToPatch(other, predicted).array().round().cast<int>();
  const int reach = kHalfPattern + static_cast<int>(std::ceil(radius));
  const cv::Rect window =
      cv::Rect(middle.x() - reach, middle.y() - reach, 2 * reach + 1, 2 * reach + 1) &
      cv::Rect(0, 0, other.grey.cols, other.grey.rows);
  if (window.width <= 2 * kHalfPattern + 2 || window.height <= 2 * kHalfPattern + 2) {
    return Sentence("matchFrame", "too near the frame");
  }
  cv::Mat scores;
  cv::matchTemplate(other.grey(window), pattern, scores, cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point at;
  cv::minMaxLoc(scores, nullptr, &best, nullptr, &at);
  if (!(best >= kLeastMatch)) return Sentence("matchNothing", "nothing there looks alike");
  if (SecondPeak(scores, at) > kSecondBest * best)
    return Sentence("matchTwo", "two places look alike");
  if (at.x == 0 || at.y == 0 || at.x + 1 == scores.cols || at.y + 1 == scores.rows) {
    return Sentence("matchUncertain", "nothing looks alike within its uncertainty");
  }
  const auto score = [&](int u, int v) { return scores.at<float>(at.y + v, at.x + u); };
  const Eigen::Vector2d found(at.x + ParabolaTop(score(-1, 0), score(0, 0), score(1, 0)),
                              at.y + ParabolaTop(score(0, -1), score(0, 0), score(0, 1)));
  MarkProposal proposal;
  const Eigen::Vector2d in_patch =
      found + Eigen::Vector2d(window.x + kHalfPattern, window.y + kHalfPattern);
  proposal.pixel = predicted + in_patch - ToPatch(other, predicted);
  proposal.shift_px = (proposal.pixel - predicted).norm();
  proposal.quality = best;
  proposal.sigma_px = std::max(kLeastSigma, 1.5 * (1 - best) + kLeastSigma);
  return proposal;
}

Eigen::Matrix2d OffsetsBetween(const PosedCamera& photo, const PosedCamera& other,
                               const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  const auto pixel_from_world = [&](const PosedCamera& posed) {
    Eigen::Matrix<double, 2, 3> by_point = Eigen::Matrix<double, 2, 3>::Zero();
    posed.camera.Project(posed.cam_from_world * point, &by_point);
    return Eigen::Matrix<double, 2, 3>(by_point * posed.cam_from_world.rotation.toRotationMatrix());
  };
  Eigen::Matrix<double, 3, 2> on_surface;
  on_surface.col(0) = normal.unitOrthogonal();
  on_surface.col(1) = normal.cross(on_surface.col(0));
  const Eigen::Matrix2d here = pixel_from_world(photo) * on_surface;
  const Eigen::Matrix2d there = pixel_from_world(other) * on_surface;
  return there * here.inverse();
}

}  // namespace insitu
