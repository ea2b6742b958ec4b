// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/calibration_verdict.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

// Limits of experience, [mrcal.secretsauce.net/how-to-calibrate.html] and [Luhmann et al., Close
// Range Photogrammetry, 7.3]: tilted views tell focal length from distance, near ones fill the
// frame, and what lies beyond the outermost boards is extrapolated.
constexpr int kFewBoards = 10;
constexpr double kTilted_deg = 20;
constexpr int kFewTilted = 3;
constexpr double kDistanceRatio = 1.2;
constexpr double kManyOutliers = 0.02, kTooManyOutliers = 0.1;  // of the corners
constexpr double kHighRms_px = 0.75, kHighRmsOfDiagonal = 1 / 4000.0;
constexpr double kDisagreement_px = 0.5;    // half a pixel hurts no montage
constexpr double kDisagreement_sigmas = 5;  // more is no chance
constexpr double kUncertain_px = 1;

void JudgeSpread(const FrameCells& cells, std::vector<Finding>* findings) {
  const int columns = cells.columns / 4, rows = cells.rows / 4;
  const struct {
    const char* name;
    int column, row;
  } corners[] = {{"upper left", 0, 0},
                 {"upper right", cells.columns - columns, 0},
                 {"lower left", 0, cells.rows - rows},
                 {"lower right", cells.columns - columns, cells.rows - rows}};
  std::string empty;
  for (const auto& corner : corners) {
    int filled = 0;
    for (int i = 0; i < columns * rows; ++i) {
      const int cell = (corner.row + i / columns) * cells.columns + corner.column + i % columns;
      filled += cells.counts[cell] > 0;
    }
    if (2 * filled < columns * rows)
      empty += (empty.empty() ? "" : ", ") + std::string(corner.name);
  }
  if (empty.empty()) return;
  findings->push_back({Severity::kReview, "Hardly any board corners in the frame's " + empty + ".",
                       "Photograph the board there too, close to the frame's edge; what lies "
                       "beyond the boards is extrapolated."});
}

void JudgeViews(const std::vector<BoardView>& boards, std::vector<Finding>* findings) {
  if (boards.empty()) return;
  const auto tilted = std::count_if(boards.begin(), boards.end(), [](const BoardView& board) {
    return board.tilt_deg > kTilted_deg;
  });
  if (tilted < kFewTilted) {
    findings->push_back(
        {tilted == 0 ? Severity::kFail : Severity::kReview,
         Formatted(tilted == 1 ? "Only %.0f board is tilted by more than %.0f degrees."
                               : "Only %.0f boards are tilted by more than %.0f degrees.",
                   static_cast<double>(tilted), kTilted_deg),
         "Photograph the board tilted by 30 to 45 degrees to all sides: boards "
         "seen straight on cannot tell the focal length from the distance."});
  }
  const auto [near, far] = std::minmax_element(
      boards.begin(), boards.end(),
      [](const BoardView& a, const BoardView& b) { return a.distance_m < b.distance_m; });
  if (far->distance_m < kDistanceRatio * near->distance_m) {
    findings->push_back({Severity::kReview,
                         Formatted("All boards stand at one distance, %.2f to %.2f m.",
                                   near->distance_m, far->distance_m),
                         "Add boards that fill the frame and boards twice as far away."});
  }
}

void JudgeResiduals(const LensAssessment& lens, const Eigen::Vector2i& size,
                    std::vector<Finding>* findings) {
  const double high = std::max(kHighRms_px, kHighRmsOfDiagonal * size.cast<double>().norm());
  if (lens.rms_px > high) {
    findings->push_back({lens.rms_px > 2 * high ? Severity::kFail : Severity::kReview,
                         Formatted("The residuals are high: RMS %.2f px, expected below %.2f px.",
                                   lens.rms_px, high),
                         "Look at the worst boards: blurred, bent or moved while the shutter was "
                         "open? Keep focus, zoom and stabiliser fixed, the board flat."});
  }
  const double share = lens.outliers / std::max(1.0, 1.0 * lens.points + lens.outliers);
  if (share > kManyOutliers) {
    findings->push_back({share > kTooManyOutliers ? Severity::kFail : Severity::kReview,
                         Formatted("%.1f %% of the corners were refused as outliers.", 100 * share),
                         "Take out the boards with many outliers, or photograph them again."});
  }
}

// Cells where a board was seen whose difference is larger than chance and half a pixel; and the
// largest difference among them.
struct Disagreement {
  int cells = 0, of = 0;
  double largest_px = 0;
};

// `sigmas`: how many of the expected ones the two lenses differ by when they differ by chance.
Disagreement Disagree(const ProjectionDifference& difference, const LensAssessment& expected,
                      double sigmas) {
  Disagreement result;
  for (size_t i = 0; i < difference.px.size(); ++i) {
    const auto& sigma = expected.uncertainty.sigma_px[i];
    if (expected.cells.counts[i] == 0 || !difference.px[i] || !sigma) continue;
    ++result.of;
    result.largest_px = std::max(result.largest_px, *difference.px[i]);
    const double limit = std::max(kDisagreement_px, kDisagreement_sigmas * sigmas * *sigma);
    result.cells += *difference.px[i] > limit;
  }
  return result;
}

// That nothing contradicts is no agreement.
Finding Incomparable(const std::string& lenses) {
  return {Severity::kReview,
          lenses + " cannot be compared: nowhere in the frame were boards seen and both known.",
          "Photograph more boards, evenly over the frame."};
}

void JudgeHalves(const BoardCalibration& calibration, std::vector<Finding>* findings) {
  if (!calibration.halves) {
    findings->push_back({Severity::kReview, "Too few boards for a cross-validation of two halves.",
                         "Photograph six boards at least, better twenty."});
    return;
  }
  // Half of the boards knows the lens 1.4 times less, and two halves differ by 1.4 times that.
  const Disagreement halves = Disagree(*calibration.halves, calibration.splined, 2);
  if (halves.of == 0) {
    findings->push_back(Incomparable("The lenses of two halves of the boards"));
    return;
  }
  if (halves.cells * 10 <= halves.of) return;
  findings->push_back(
      {Severity::kReview,
       Formatted("Two halves of the boards give different lenses: up to %.2f px apart "
                 "where boards were seen, at %.0f %% of the places more than chance "
                 "explains.",
                 halves.largest_px, 100.0 * halves.cells / halves.of),
       "Did zoom, focus or the board change in between? Else photograph more "
       "boards, evenly over the frame."});
}

void JudgeModel(const BoardCalibration& calibration, std::vector<Finding>* findings) {
  const Disagreement model = Disagree(calibration.splined_difference, calibration.splined, 1);
  if (model.of == 0) {
    findings->push_back(Incomparable("The lens model and the splined one"));
    return;
  }
  if (model.cells * 10 <= model.of) return;
  findings->push_back(
      {Severity::kReview,
       Formatted("The lens model does not describe this lens: up to %.2f px from the "
                 "splined model where boards were seen, at %.0f %% of the places more "
                 "than chance explains.",
                 model.largest_px, 100.0 * model.cells / model.of),
       "Calibrate with --lens-model " + calibration.splined_lens_model + "."});
}

void JudgeUncertainty(const LensAssessment& lens, std::vector<Finding>* findings) {
  int uncertain = 0, seen = 0;
  for (size_t i = 0; i < lens.cells.counts.size(); ++i) {
    if (lens.cells.counts[i] == 0) continue;
    const auto& sigma = lens.uncertainty.sigma_px[i];
    ++seen;
    uncertain += !sigma || *sigma > kUncertain_px;
  }
  if (seen == 0) {
    findings->push_back({Severity::kFail,
                         "How uncertain the projection is, is not known: no corners were used.",
                         "Photograph the board again, sharp and wholly visible."});
    return;
  }
  if (uncertain * 10 <= seen) return;
  findings->push_back(
      {uncertain * 2 > seen ? Severity::kFail : Severity::kReview,
       Formatted("The projection is uncertain by more than %.0f px at %.0f %% of the "
                 "places where boards were seen.",
                 kUncertain_px, 100.0 * uncertain / seen),
       "Photograph more boards, larger in the frame."});
}

}  // namespace

std::vector<Finding> JudgeLens(const LensAssessment& lens, const Eigen::Vector2i& size) {
  std::vector<Finding> findings;
  if (lens.boards.size() < kFewBoards) {
    findings.push_back(
        {Severity::kReview,
         Formatted(lens.boards.size() == 1 ? "Only %.0f board." : "Only %.0f boards.",
                   static_cast<double>(lens.boards.size())),
         "Photograph twenty boards or more."});
  }
  JudgeSpread(lens.cells, &findings);
  JudgeViews(lens.boards, &findings);
  JudgeResiduals(lens, size, &findings);
  return findings;
}

std::vector<Finding> JudgeBoards(const BoardCalibration& calibration, const Eigen::Vector2i& size) {
  std::vector<Finding> findings = JudgeLens(calibration.lens, size);
  JudgeHalves(calibration, &findings);
  JudgeModel(calibration, &findings);
  JudgeUncertainty(calibration.splined, &findings);
  return findings;
}

}  // namespace insitu
