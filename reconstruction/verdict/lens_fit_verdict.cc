// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/lens_fit_verdict.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "calibration/files/wording.h"
#include "reconstruction/network/statistics.h"

namespace insitu {
namespace {

constexpr int kRings = 8, kColumnsOfLens = 4, kRowsOfLens = 3;
constexpr int kFewestMarks = 40;  // of a camera
constexpr double kChance = 1e-4;
constexpr double kClip = 4;         // a gross error is another finding
constexpr double kLeastMean = 0.4;  // [sigma], less moves nothing that matters

// A mark's two test values and residuals, and where it is.
struct LensMark {
  int photo = 0;
  Eigen::Vector2d pixel = {0, 0}, w = {0, 0}, residual = {0, 0};
  int parts = 0;  // of x and y
};

struct LensBin {
  double marks = 0;
  Eigen::Vector2d w = {0, 0}, residual = {0, 0};  // sums

  void Add(const Eigen::Vector2d& test_value, const Eigen::Vector2d& px) {
    marks += 1;
    w += test_value.cwiseMax(-kClip).cwiseMin(kClip);
    residual += px;
  }
};

std::vector<LensMark> LensMarks(const Adjustment& adjustment) {
  std::map<std::string, int> index;
  for (size_t i = 0; i < adjustment.poses.size(); ++i)
    index[adjustment.poses[i].photo] = static_cast<int>(i);
  std::map<std::pair<int, std::string>, LensMark> marks;
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.kind != ObservationKind::kImage || !row.w) continue;
    const int photo = index.at(row.photo);
    LensMark& mark = marks[{photo, row.subject}];
    mark.photo = photo;
    mark.pixel[row.axis] = row.observed;
    mark.w[row.axis] = *row.w;
    mark.residual[row.axis] = row.residual;
    ++mark.parts;
  }
  std::vector<LensMark> whole;
  for (const auto& [key, mark] : marks) {
    if (mark.parts == 2) whole.push_back(mark);
  }
  return whole;
}

// The test of some bins, whose `names` say where they are.
std::optional<LensMisfit> Tested(const std::vector<LensBin>& bins,
                                 const std::vector<std::string>& names, double variance) {
  LensMisfit misfit;
  int degrees = 0;
  double largest = 0;
  for (size_t i = 0; i < bins.size(); ++i) {
    const LensBin& bin = bins[i];
    if (bin.marks < 3) continue;
    degrees += 2;
    misfit.statistic += bin.w.squaredNorm() / bin.marks / variance;
    const double mean = (bin.w / bin.marks).norm() / std::sqrt(variance);
    const bool is_sure = mean * std::sqrt(bin.marks) > 3;
    if (!is_sure || mean <= largest) continue;
    largest = mean;
    misfit.largest_px = (bin.residual / bin.marks).norm();
    misfit.where = names[i];
  }
  if (degrees == 0 || largest < kLeastMean) return std::nullopt;
  misfit.limit = ChiSquareQuantile(degrees, 1 - kChance);
  return misfit.statistic > misfit.limit ? std::optional(misfit) : std::nullopt;
}

std::optional<LensMisfit> ByRadius(const std::vector<LensMark>& marks, const Eigen::Vector2d& size,
                                   double variance) {
  const Eigen::Vector2d middle = (size.array() - 1) / 2;
  const double step = size.norm() / 2 / kRings;
  std::vector<LensBin> rings(kRings);
  std::vector<std::string> names;
  for (int i = 0; i < kRings; ++i)
    names.push_back(Formatted("%.0f to %.0f px from the middle", i * step, (i + 1) * step));
  for (const LensMark& mark : marks) {
    const Eigen::Vector2d ray = mark.pixel - middle;
    const double radius = ray.norm();
    if (radius == 0) continue;
    Eigen::Matrix2d polar;  // radial, tangential
    polar << ray.x(), ray.y(), -ray.y(), ray.x();
    polar /= radius;
    rings[std::min(static_cast<int>(radius / step), kRings - 1)].Add(polar * mark.w,
                                                                     polar * mark.residual);
  }
  auto misfit = Tested(rings, names, variance);
  if (misfit) misfit->by = "radius";
  return misfit;
}

std::optional<LensMisfit> ByPlace(const std::vector<LensMark>& marks, const Eigen::Vector2d& size,
                                  double variance) {
  const auto cell = [](double part, int count) {
    return std::clamp(static_cast<int>(std::floor(part * count)), 0, count - 1);
  };
  std::vector<LensBin> cells(size_t{kColumnsOfLens} * kRowsOfLens);
  std::vector<std::string> names;
  for (int row = 0; row < kRowsOfLens; ++row) {
    for (int column = 0; column < kColumnsOfLens; ++column) {
      names.push_back(Formatted("around (%.0f, %.0f)", (column + 0.5) * size.x() / kColumnsOfLens,
                                (row + 0.5) * size.y() / kRowsOfLens));
    }
  }
  for (const LensMark& mark : marks) {
    const int column = cell(mark.pixel.x() / size.x(), kColumnsOfLens),
              row = cell(mark.pixel.y() / size.y(), kRowsOfLens);
    cells[static_cast<size_t>(row) * kColumnsOfLens + column].Add(mark.w, mark.residual);
  }
  auto misfit = Tested(cells, names, variance);
  if (misfit) misfit->by = "place in the frame";
  return misfit;
}

}  // namespace

std::vector<LensMisfit> FindLensMisfits(const Adjustment& adjustment) {
  std::map<int, std::vector<LensMark>> marks_of_camera;
  for (const LensMark& mark : LensMarks(adjustment)) {
    marks_of_camera[adjustment.poses[static_cast<size_t>(mark.photo)].camera].push_back(mark);
  }
  const double variance = std::max(1.0, adjustment.sigma0 * adjustment.sigma0);
  std::vector<LensMisfit> misfits;
  for (const auto& [camera, marks] : marks_of_camera) {
    if (marks.size() < kFewestMarks) continue;
    const Camera& lens = adjustment.scene.cameras[static_cast<size_t>(marks.front().photo)].camera;
    const Eigen::Vector2d size(lens.width(), lens.height());
    auto misfit = ByRadius(marks, size, variance);
    if (!misfit) misfit = ByPlace(marks, size, variance);
    if (!misfit) continue;
    misfit->camera = camera;
    misfits.push_back(*misfit);
  }
  return misfits;
}

void JudgeLensFit(const Adjustment& adjustment, std::vector<Finding>* findings) {
  for (const LensMisfit& misfit : FindLensMisfits(adjustment)) {
    findings->push_back(
        {Severity::kReview,
         "the lens of camera '" + adjustment.cameras[static_cast<size_t>(misfit.camera)].name +
             "' does not fit: the residuals are not zero on average as a function of " + misfit.by +
             ", up to " + ShortNumber(misfit.largest_px) + " px " + misfit.where + " (test value " +
             Number("%.0f", misfit.statistic) + " where chance gives at most " +
             Number("%.0f", misfit.limit) + "); poses and sigmas are not to be trusted",
         "let --self-calibrate adjust the lens with the site and compare, or calibrate it from "
         "boards at the same focus, "
         "zoom and stabilisation"});
  }
}

}  // namespace insitu
