// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnose_copies.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "calibration/files/wording.h"
#include "reconstruction/diagnosis/control_fit.h"

namespace insitu {
namespace {

constexpr double kGoodCopyFit = 5;      // [sigma]
constexpr double kCopyImprovement = 4;  // of the RMS
constexpr double kScaleStep =
    1.06;  // of the search, fine enough for the refinement to find the rest
constexpr double kSmallestScale = 0.2,
                 kLargestScale = 400;  // of the photograph against the copy; 400: millimetres
constexpr double kNoScale = 0.03;      // [ln], nearer to 1 it is rather the lens that is wrong
constexpr double kNoShift = 5;         // [px], the same
constexpr double kLargestResize = 20;  // of the photograph against a resized copy
constexpr size_t kMostCopies = 4;      // photos, enough evidence and quick with hundreds
constexpr double kLargestMm = 100;     // [mm], the side of a sensor or a film; no copy is so small

// What takes a pixel of the copy to one of the photograph: scaled about the corner, then shifted.
struct CopyTransform {
  Eigen::Vector2d scale = {1, 1};
  Eigen::Vector2d shift = {0, 0};  // [px]

  Eigen::Vector2d operator()(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d corner = pixel.array() + 0.5;
    return scale.cwiseProduct(corner).array() - 0.5 + shift.array();
  }
};

// One photo with its control, apart from the rest: fits are tried by the hundred.
class CopyTrial {
 public:
  CopyTrial(const DiagnosisInput& input, size_t photo)
      : photos_{input.photos[photo]}, cameras_{input.cameras[photo]} {
    for (const ControlMark& mark : ControlMarksOn(input.survey, input.photos[photo])) {
      survey_.control_points.push_back(*mark.control);
      survey_.observations.push_back(*mark.mark);
    }
    given_ = survey_.observations;
  }

  size_t marks() const { return given_.size(); }
  const Camera& camera() const { return cameras_[0]; }
  const std::vector<ImageObservation>& given() const { return given_; }

  std::optional<ControlFit> Fit(const CopyTransform& copy) {
    // Of a resized copy in its pixels; of other units nobody states a sigma in them.
    const double sigma = copy.scale.mean() > kLargestResize ? 1 : copy.scale.mean();
    for (size_t i = 0; i < given_.size(); ++i) {
      survey_.observations[i].pixel = copy(given_[i].pixel);
      survey_.observations[i].sigma_px = sigma * given_[i].sigma_px;
      if (!cameras_[0].Sees(survey_.observations[i].pixel)) return std::nullopt;
    }
    return FitControl(survey_, photos_, cameras_, 0);
  }

  // RMS in the copy's own unit, which no scale makes small; infinite without a pose.
  double Misfit(const CopyTransform& copy) {
    const auto fit = Fit(copy);
    return fit ? fit->rms_px / copy.scale.mean() : std::numeric_limits<double>::infinity();
  }

 private:
  Survey survey_;
  std::vector<ImageObservation> given_;
  std::vector<std::string> photos_;
  std::vector<Camera> cameras_;
};

CopyTransform Scaled(double scale) { return {{scale, scale}, {0, 0}}; }

// The minimum between two scales, by golden sections of their logarithm.
double BestScaleBetween(CopyTrial* trial, double from, double to) {
  constexpr double kGolden = 0.6180339887498949;
  double a = std::log(from), b = std::log(to);
  for (int i = 0; i < 24; ++i) {
    const double left = b - kGolden * (b - a), right = a + kGolden * (b - a);
    const bool is_left =
        trial->Misfit(Scaled(std::exp(left))) < trial->Misfit(Scaled(std::exp(right)));
    (is_left ? b : a) = is_left ? right : left;
  }
  return std::exp((a + b) / 2);
}

double BestScale(CopyTrial* trial) {
  double best = 1, least = std::numeric_limits<double>::infinity();
  for (double scale = kSmallestScale; scale < kLargestScale; scale *= kScaleStep) {
    const double misfit = trial->Misfit(Scaled(scale));
    if (misfit < least) best = scale;
    least = std::min(least, misfit);
  }
  return BestScaleBetween(trial, best / kScaleStep, best * kScaleStep);
}

// Nelder and Mead's simplex over (ln scale, shift / width).
CopyTransform Refined(CopyTrial* trial, const CopyTransform& start, bool has_scale) {
  const double width = trial->camera().width();
  const auto copy_of = [&](const Eigen::Vector3d& x) {
    const double scale = has_scale ? std::exp(x[0]) : 1;
    return CopyTransform{Eigen::Vector2d::Constant(scale), width * x.tail<2>()};
  };
  using Vertex = std::pair<double, Eigen::Vector3d>;
  const auto at = [&](const Eigen::Vector3d& x) { return Vertex(trial->Misfit(copy_of(x)), x); };
  const Eigen::Vector3d first(std::log(start.scale.mean()), start.shift.x() / width,
                              start.shift.y() / width);
  std::vector<Vertex> simplex = {at(first)};
  for (int i = 0; i < 3; ++i) simplex.push_back(at(first + 0.1 * Eigen::Vector3d::Unit(i)));
  const auto is_less = [](const Vertex& a, const Vertex& b) { return a.first < b.first; };
  for (int step = 0; step < 100; ++step) {
    std::sort(simplex.begin(), simplex.end(), is_less);
    if ((simplex[3].second - simplex[0].second).norm() < 1e-7) break;
    const Eigen::Vector3d middle = (simplex[0].second + simplex[1].second + simplex[2].second) / 3;
    const Eigen::Vector3d away = middle - simplex[3].second;
    Vertex moved = at(middle + away);
    if (moved.first < simplex[0].first) moved = std::min(moved, at(middle + 2 * away), is_less);
    if (!(moved.first < simplex[2].first))
      moved = std::min(moved, at(middle - 0.5 * away), is_less);
    if (moved.first < simplex[3].first) {
      simplex[3] = moved;
      continue;
    }
    for (int i = 1; i < 4; ++i) simplex[i] = at((simplex[0].second + simplex[i].second) / 2);
  }
  return copy_of(std::min_element(simplex.begin(), simplex.end(), is_less)->second);
}

enum class CopyKind { kResized, kCropped, kResizedCropped, kShares, kMillimetres };

struct Copy {
  CopyKind kind;
  CopyTransform transform;
  double rms_px = 0;
};

// `given_rms` as the marks stand; infinite: they fit no pose.
std::optional<Copy> Tried(CopyTrial* trial, CopyKind kind, const CopyTransform& transform,
                          double given_rms) {
  const auto fit = trial->Fit(transform);
  if (!fit || !(fit->rms_over_sigma < kGoodCopyFit)) return std::nullopt;
  const double better = given_rms * transform.scale.mean() / kCopyImprovement;
  if (!(fit->rms_px < better)) return std::nullopt;
  return Copy{kind, transform, fit->rms_px};
}

bool AreShares(const CopyTrial& trial) {
  return std::all_of(trial.given().begin(), trial.given().end(), [](const ImageObservation& mark) {
    return mark.pixel.minCoeff() >= -0.5 && mark.pixel.maxCoeff() <= 1;
  });
}

bool AreMillimetres(const CopyTrial& trial) {
  return std::all_of(trial.given().begin(), trial.given().end(), [](const ImageObservation& mark) {
    return mark.pixel.maxCoeff() < kLargestMm;
  });
}

// The simplest copy that explains the marks.
std::optional<Copy> FindCopy(CopyTrial* trial) {
  if (trial->marks() < 5) return std::nullopt;
  const auto as_given = trial->Fit({});
  constexpr double kNoFit = std::numeric_limits<double>::infinity();
  const double rms = as_given ? as_given->rms_px : kNoFit;
  const Eigen::Vector2d size(trial->camera().width(), trial->camera().height());
  if (AreShares(*trial)) {
    const CopyTransform shares{size, -0.5 * size};  // (0, 0) is the picture's corner
    if (auto copy = Tried(trial, CopyKind::kShares, shares, kNoFit)) return copy;
  }
  const double scale = BestScale(trial);
  if (std::abs(std::log(scale)) > kNoScale) {
    const CopyKind kind = AreMillimetres(*trial) ? CopyKind::kMillimetres : CopyKind::kResized;
    CopyTransform transform = Scaled(scale);
    if (auto copy = Tried(trial, kind, transform, rms)) return copy;
  }
  if (trial->marks() < 7) return std::nullopt;
  const CopyTransform cropped = Refined(trial, {}, false);
  if (cropped.shift.norm() > kNoShift) {
    if (auto copy = Tried(trial, CopyKind::kCropped, cropped, rms)) return copy;
  }
  if (trial->marks() < 8) return std::nullopt;
  const CopyTransform both = Refined(trial, Scaled(scale), true);
  const double resized = both.scale.mean();
  const bool is_plausible = std::abs(std::log(resized)) > kNoScale && resized > kSmallestScale &&
                            resized < kLargestResize &&
                            (both.shift.array().abs() < size.array()).all();
  if (!is_plausible) return std::nullopt;
  return Tried(trial, CopyKind::kResizedCropped, both, rms);
}

// The scale of a copy of a round size, if the estimate is as near to one as it is sure.
double Rounded(double scale) {
  constexpr double kRound = 0.05, kNear = 0.004;
  const double size = std::round(1 / scale / kRound) * kRound;
  return size > 0 && std::abs(size * scale - 1) < kNear ? 1 / size : scale;
}

Sentence SaidCopy(const Copy& copy) {
  const double scale = Rounded(copy.transform.scale.mean());
  const std::string factor = ShortNumber(scale), size = ShortNumber(1 / scale);
  const std::string x = ShortNumber(copy.transform.shift.x()),
                    y = ShortNumber(copy.transform.shift.y());
  switch (copy.kind) {
    case CopyKind::kResized:
      return Sentence("copyResized",
                      "the marks were measured on a copy {size} times as large as the photograph: "
                      "multiply x + 0.5 and "
                      "y + 0.5 by {factor} and subtract 0.5",
                      {{"size", size}, {"factor", factor}});
    case CopyKind::kMillimetres:
      return Sentence("copyMillimetres",
                      "the marks are in millimetres from the corner, with {factor} pixels a "
                      "millimetre, expected pixels "
                      "of the photograph",
                      {{"factor", factor}});
    case CopyKind::kShares:
      return Sentence("copyShares",
                      "the marks are shares of the photograph's sides, expected pixels: multiply x "
                      "by its width and y by "
                      "its height, and subtract 0.5");
    case CopyKind::kCropped:
      return Sentence("copyCropped",
                      "the marks were measured on a copy that is cropped by {x} px at its left and "
                      "{y} px at its top: add "
                      "them to x and y",
                      {{"x", x}, {"y", y}});
    case CopyKind::kResizedCropped:
      return Sentence("copyResizedCropped",
                      "the marks were measured on a cropped copy {size} times as large: multiply x "
                      "and y by {factor} and "
                      "add {x} and {y} px",
                      {{"size", size}, {"factor", factor}, {"x", x}, {"y", y}});
  }
  return {};
}

bool IsSameCopy(const Copy& a, const Copy& b) {
  return a.kind == b.kind &&
         std::abs(std::log(a.transform.scale.mean() / b.transform.scale.mean())) < 0.01 &&
         (a.transform.shift - b.transform.shift).norm() < 20;
}

}  // namespace

std::vector<Diagnosis> DiagnoseCopies(const DiagnosisInput& input, const std::vector<size_t>& bad) {
  std::vector<std::string> photos;
  std::optional<Copy> first;
  double given = 0;  // 0: no pose as given
  FilePlace place;
  size_t tried = 0;
  for (const size_t photo : bad) {
    if (tried++ == kMostCopies) break;
    CopyTrial trial(input, photo);
    const auto copy = FindCopy(&trial);
    if (!copy || (first && !IsSameCopy(*first, *copy))) continue;
    if (!first) {
      const auto fit = trial.Fit({});
      if (fit) given = fit->rms_px;
      first = copy;
      place = trial.given().front().place;
    }
    first->rms_px = std::max(first->rms_px, copy->rms_px);
    photos.push_back(input.photos[photo]);
  }
  if (!first) return {};
  Sentence::Values values = {{"copy", SaidCopy(*first).ToJson()},
                             {"photos", SaidPhotos(photos)},
                             {"rms", ShortNumber(first->rms_px)}};
  if (given == 0) {
    return {{place, Sentence("copyNoFit",
                             "{copy}. The marks of control points on {photos} fit no camera "
                             "position as given, and to "
                             "{rms} px (RMS) then",
                             values)}};
  }
  values["given"] = ShortNumber(given);
  return {{place, Sentence("copyFit",
                           "{copy}. The marks of control points on {photos} fit to {given} px "
                           "(RMS) as given, and to "
                           "{rms} px then",
                           values)}};
}

}  // namespace insitu
