// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/verdict.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/wording.h"
#include "reconstruction/network/variance_factor.h"
#include "reconstruction/verdict/advice.h"
#include "reconstruction/verdict/geometry_verdict.h"
#include "reconstruction/verdict/lens_fit_verdict.h"

namespace insitu {
namespace {

constexpr double kInseparable = 0.99;     // correlation of two unknowns of a photo or camera
constexpr double kCheckLimit = 1.5;       // root mean square over combined sigma; twice that fails
constexpr double kLikelyByChance = 0.05;  // that so large a test value is somewhere among so many
// A sigma0 within such a factor of 1 is no fault: all sigmas reported follow it, and with tens of
// thousands of tie points a test finds any.
constexpr double kSigma0Band = 1.1;

void JudgeGlobalTest(const Adjustment& adjustment, std::vector<Finding>* findings) {
  const GlobalTest& test = adjustment.global_test;
  if (adjustment.redundancy == 0) {
    findings->push_back({Severity::kReview, "no redundancy: errors cannot be found",
                         "measure more marks or survey more control points"});
  } else if (adjustment.chi_square_p < test.alpha) {
    const bool is_worse = adjustment.sigma0 > 1;
    const std::string figures = "the global test is not met: sigma0 " +
                                Number("%.2f", adjustment.sigma0) + ", p " +
                                Number("%.4f", adjustment.chi_square_p);
    const bool is_harmless = adjustment.sigma0 > 1 / kSigma0Band && adjustment.sigma0 < kSigma0Band;
    findings->push_back(
        {adjustment.sigma0 > 2 ? Severity::kFail
         : is_harmless         ? Severity::kNote
                               : Severity::kReview,
         figures + (is_worse ? "; the observations are worse than their sigmas say, or one is wrong"
                             : "; the observations are better than their sigmas say"),
         is_worse
             ? "correct flagged observations first, one at a time; if none is left, state the "
               "larger sigmas that the table of groups shows"
             : "state smaller sigmas, by the table of groups: sigma0 of a group is the factor"});
  }
}

// Student's 97.5 % quantiles of 1 to 19 degrees of freedom.
constexpr double kStudent[] = {12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31, 2.26, 2.23,
                               2.20,  2.18, 2.16, 2.14, 2.13, 2.12, 2.11, 2.10, 2.09};

void JudgeRedundancy(const Adjustment& adjustment, std::vector<Finding>* findings) {
  const int redundancy = adjustment.redundancy;
  if (redundancy < 1 || redundancy >= kWellKnownRedundancy) return;
  findings->push_back(
      {Severity::kNote,
       "the redundancy is " + std::to_string(redundancy) +
           ": sigma0 is hardly known, so that no sigma is scaled below what the observations' own "
           "sigmas give" +
           (adjustment.sigma0 > 1 ? ", and a 95 % interval is +- " +
                                        Number("%.2f", kStudent[redundancy - 1]) + " sigma"
                                  : ""),
       "measure more marks"});
}

struct FlagCount {
  int flagged = 0, tested = 0;
};

FlagCount CountFlagged(const Adjustment& adjustment, bool of_tie_points) {
  FlagCount count;
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.is_tie_point != of_tie_points || !row.w) continue;
    ++count.tested;
    count.flagged += std::abs(*row.w) > adjustment.critical_w;
  }
  return count;
}

// What the surveyor measured, one observation at a time.
void JudgeObservations(const Adjustment& adjustment, std::vector<Finding>* findings) {
  const std::optional<ObservationResidual> suspect = Suspect(adjustment);
  if (!suspect || suspect->is_tie_point) return;
  const double w = std::abs(*suspect->w);
  const auto [flagged, tested] = CountFlagged(adjustment, false);
  const bool is_by_chance = tested * std::erfc(w / std::sqrt(2.0)) > kLikelyByChance;
  const std::string reason =
      std::to_string(flagged) + (flagged == 1 ? " observation has" : " observations have") +
      " a test value over " + Number("%.2f", adjustment.critical_w) + "; the suspect is " +
      Describe(*suspect) + ", w " + Number("%.1f", *suspect->w) +
      (is_by_chance ? ", which good observations reach where there are so many" : "");
  findings->push_back({w > 2 * adjustment.critical_w ? Severity::kFail
                       : is_by_chance                ? Severity::kNote
                                                     : Severity::kReview,
                       reason,
                       Advice(*suspect) + "; then adjust again before judging the next one"});
}

// Tie points were chosen by a program out of thousands; only their share counts.
void JudgeTiePoints(const Adjustment& adjustment, std::vector<Finding>* findings) {
  const FlagCount count = CountFlagged(adjustment, true);
  const double by_chance = count.tested * std::erfc(adjustment.critical_w / std::sqrt(2.0));
  if (count.flagged <= by_chance + 3 * std::sqrt(by_chance) + 1) return;
  findings->push_back(
      {Severity::kReview,
       std::to_string(count.flagged) + " of " + std::to_string(count.tested) +
           " coordinates of tie points have a test value over " +
           Number("%.2f", adjustment.critical_w) + ", where chance explains " +
           Number("%.0f", by_chance),
       "run insitu-tie-points anew with fewer points (--points), or mark points by hand where "
       "image matching errs: foliage, water, repeated windows"});
}

void JudgeControl(const Adjustment& adjustment, std::vector<Finding>* findings) {
  int weak = 0, marks = 0;
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.kind != ObservationKind::kImage) continue;
    ++marks;
    weak += row.redundancy < kWeaklyControlled;
  }
  if (weak == 0) return;
  findings->push_back(
      {Severity::kNote,
       std::to_string(weak) + " of " + std::to_string(marks) +
           " image coordinates are hardly controlled by others (redundancy number below 0.1): an "
           "error in them would not show",
       "mark their points on more photos"});
}

// Centre and rotation of one photo are correlated by nature, and those of a far point lie along its
// ray; only what can hardly be told apart spoils the result.
void JudgeCorrelations(const Adjustment& adjustment, std::vector<Finding>* findings) {
  if (adjustment.correlations.empty()) return;
  std::vector<std::string> pairs;
  Severity severity = Severity::kNote;
  bool is_of_lens = false;
  for (const Correlation& pair : adjustment.correlations) {
    is_of_lens |= pair.of == Correlation::Of::kCamera;
    pairs.push_back(pair.first + " with " + pair.second + " " + Number("%.3f", pair.value));
    if (pair.of != Correlation::Of::kPoint && std::abs(pair.value) > kInseparable)
      severity = Severity::kReview;
  }
  findings->push_back({severity,
                       Listing("correlations above " + Number("%.2f", kHighCorrelation), pairs, 3),
                       std::string("where that matters, take photos from other sides, some "
                                   "turned by 90 degrees, and spread control in depth") +
                           (is_of_lens ? "; of a lens, calibrate a model of fewer parameters "
                                         "(insitu-calibrate --lens-model LENSMODEL_OPENCV4)"
                                       : "")});
}

std::vector<std::string> WorstPoints(const std::vector<PointComparison>& comparisons) {
  std::vector<std::pair<double, std::string>> points;
  for (const PointComparison& point : comparisons) {
    const double over_sigma = point.difference.cwiseQuotient(point.sigma).cwiseAbs().maxCoeff();
    if (over_sigma > 3) points.emplace_back(-over_sigma, point.name);
  }
  std::sort(points.begin(), points.end());
  std::vector<std::string> names;
  for (const auto& [minus_over_sigma, name] : points) names.push_back(name);
  return names;
}

Finding Disagreement(const std::string& what, double rms,
                     const std::vector<PointComparison>& comparisons) {
  const std::vector<std::string> worst = WorstPoints(comparisons);
  return {rms > 2 * kCheckLimit ? Severity::kFail : Severity::kReview,
          what + " by " + Number("%.2f", rms) + " times the sigma expected" +
              (worst.empty() ? "" : "; " + Listing("more than 3 sigma off", worst)),
          "check their coordinates and marks; if they are right, control, marks or lens are worse "
          "than their sigmas say"};
}

void JudgeAccuracy(const Adjustment& adjustment, std::vector<Finding>* findings) {
  if (adjustment.check_rms_over_sigma > kCheckLimit) {
    findings->push_back(
        Disagreement("the check points differ", adjustment.check_rms_over_sigma, adjustment.check));
  }
  if (!adjustment.check.empty()) return;
  std::string reason = "no check points: accuracy not verified independently";
  if (!adjustment.left_out.empty()) {
    reason += "; each control point predicted from the rest of the network differs by " +
              Number("%.2f", adjustment.left_out_rms_over_sigma) + " times the sigma expected";
  }
  findings->push_back({Severity::kReview, reason,
                       "survey some well spread points more and give them the role check"});
  if (adjustment.left_out_rms_over_sigma > kCheckLimit) {
    findings->push_back(Disagreement("control points contradict one another",
                                     adjustment.left_out_rms_over_sigma, adjustment.left_out));
  }
}

void JudgeDatum(const Adjustment& adjustment, std::vector<Finding>* findings) {
  if (adjustment.datum_defect == 0) return;
  findings->push_back(
      {Severity::kReview, "the datum is " + adjustment.datum,
       "survey three control points or more, not on one line, and mark them on two photos each"});
}

void JudgePlanes(const PlaneEffect& effect, double critical_w, std::vector<Finding>* findings) {
  if (effect.degrees == 0 || effect.statistic <= effect.limit) return;
  std::vector<std::pair<double, std::string>> moved;
  for (const PlaneEffect::Shift& shift : effect.shifts) {
    const double w = std::abs(shift.w.value_or(0));
    if (w > critical_w) {
      moved.emplace_back(-w, shift.name + Number(" by %.0f mm", 1000 * shift.difference.norm()));
    }
  }
  std::sort(moved.begin(), moved.end());
  std::vector<std::string> names;
  for (const auto& [minus_w, name] : moved) names.push_back(name);
  findings->push_back(
      {Severity::kReview,
       "the planes do not all hold: they add " + Number("%.0f", effect.statistic) +
           " to the sum of squares where at most " + Number("%.0f", effect.limit) + " is expected" +
           (names.empty() ? "" : "; " + Listing("they move", names, 3)),
       "look at the vertices' distances from their planes: correct marks of the worst, split "
       "polygons that are not flat, or state a larger --plane-sigma"});
}

bool IsAdjusted(const AdjustedCamera& camera) {
  return std::any_of(camera.parameters.begin(), camera.parameters.end(),
                     [](const AdjustedCamera::Parameter& each) { return each.is_adjusted; });
}

// Sigmas without the lens's part are too small, and smaller than those of an honest calibration.
void JudgeExactLens(const AdjustedCamera& camera, std::vector<Finding>* findings) {
  if (camera.is_considered || IsAdjusted(camera)) return;
  const bool is_splined = camera.lens_model.starts_with("LENSMODEL_SPLINED");
  findings->push_back(
      {Severity::kReview,
       "the lens of camera '" + camera.name + "' counts as exact, since " +
           (is_splined ? "a splined model brings no covariance"
                       : "its calibration states no covariance") +
           ": every sigma leaves the lens's errors out and is too small",
       std::string("calibrate it from boards") +
           (is_splined ? " with --lens-model LENSMODEL_OPENCV8, or see the lens's uncertainty map "
                         "for what is left out"
                       : ", or let --self-calibrate adjust it with the site")});
}

// What the calibration's own report objects to, one degree less where the adjustment made the lens
// its own: a failed calibration never leaves a pass.
void JudgeCalibration(const AdjustedCamera& camera, const Json::Value& calibration,
                      std::vector<Finding>* findings) {
  const bool is_adjusted = IsAdjusted(camera);
  const std::string name = "calibration of '" + camera.name + "': ";
  if (!calibration.isObject()) {
    findings->push_back({Severity::kNote,
                         name + "no report of it: how sure the lens is, is unknown",
                         "run insitu-calibrate"});
    return;
  }
  for (const Finding& of_boards : FindingsOf(calibration["verdict"])) {
    Finding finding{of_boards.severity, name + of_boards.reason, of_boards.remedy};
    if (is_adjusted && finding.severity != Severity::kNote) {
      finding.severity = finding.severity == Severity::kFail ? Severity::kReview : Severity::kNote;
    }
    findings->push_back(finding);
  }
}

void PassOnWarnings(const Adjustment& adjustment, std::vector<Finding>* findings) {
  for (const std::string& warning : adjustment.warnings) {
    findings->push_back({Severity::kReview, warning, ""});
  }
}

}  // namespace

std::optional<ObservationResidual> Suspect(const Adjustment& adjustment) {
  for (const bool of_tie_points : {false, true}) {
    const ObservationResidual* suspect = nullptr;
    double largest = adjustment.critical_w;
    for (const ObservationResidual& row : adjustment.residuals) {
      if (row.is_tie_point != of_tie_points || std::abs(row.w.value_or(0)) <= largest) continue;
      largest = std::abs(*row.w);
      suspect = &row;
    }
    if (suspect) return *suspect;
  }
  return std::nullopt;
}

std::vector<Finding> Judge(const Adjustment& adjustment, const CameraContexts& cameras) {
  std::vector<Finding> findings;
  JudgeGlobalTest(adjustment, &findings);
  JudgeRedundancy(adjustment, &findings);
  if (!adjustment.is_converged) {
    findings.push_back({Severity::kFail, "the adjustment has not converged: no figure holds",
                        "look for gross errors: names exchanged, units, a photo's start value"});
  }
  JudgeObservations(adjustment, &findings);
  JudgeTiePoints(adjustment, &findings);
  JudgeAccuracy(adjustment, &findings);
  JudgeDatum(adjustment, &findings);
  JudgePlanes(adjustment.plane_effect, adjustment.critical_w, &findings);
  JudgeGeometry(adjustment, cameras, &findings);
  for (size_t i = 0; i < adjustment.cameras.size(); ++i) {
    JudgeExactLens(adjustment.cameras[i], &findings);
    JudgeCalibration(adjustment.cameras[i], ContextOf(cameras, static_cast<int>(i)).calibration,
                     &findings);
  }
  JudgeLensFit(adjustment, &findings);
  JudgeCorrelations(adjustment, &findings);
  PassOnWarnings(adjustment, &findings);
  JudgeControl(adjustment, &findings);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings;
}

}  // namespace insitu
