// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/calibration_verdict.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

constexpr int kNodes = kFrameColumns * kFrameRows;
const Eigen::Vector2i kSize(1800, 1200);

LensAssessment GoodLens() {
  LensAssessment lens;
  lens.points = 2000;
  lens.rms_px = 0.2;
  lens.uncertainty = {kFrameColumns, kFrameRows, std::vector<std::optional<double>>(kNodes, 0.1),
                      0.1};
  lens.cells = {kFrameColumns, kFrameRows, std::vector<int>(kNodes, 17),
                std::vector<double>(kNodes, 0), std::vector<double>(kNodes, 0)};
  for (int i = 0; i < 20; ++i) lens.boards.push_back({"", 100, 0, 0.2, 0.6, 2.0 * i, 1 + 0.1 * i});
  return lens;
}

ProjectionDifference Difference(double px) {
  return {kFrameColumns,
          kFrameRows,
          std::vector<std::optional<double>>(kNodes, px),
          Eigen::Quaterniond::Identity(),
          px,
          px};
}

BoardCalibration Good() {
  BoardCalibration calibration;
  calibration.boards_found = calibration.board_photos = 20;
  calibration.lens = calibration.splined = GoodLens();
  calibration.splined_difference = Difference(0.05);
  calibration.halves = Difference(0.2);
  return calibration;
}

// The only finding, its words and what to do.
std::string OnlyFinding(const BoardCalibration& calibration) {
  const auto findings = JudgeBoards(calibration, kSize);
  EXPECT_EQ(findings.size(), 1u);
  if (findings.size() != 1) return "";
  EXPECT_FALSE(findings[0].remedy.empty());
  return findings[0].reason;
}

TEST(CalibrationVerdict, Good) { EXPECT_TRUE(JudgeBoards(Good(), kSize).empty()); }

TEST(CalibrationVerdict, FewBoards) {
  BoardCalibration calibration = Good();
  calibration.lens.boards.resize(9);
  for (BoardView& board : calibration.lens.boards) board.tilt_deg = 30;
  EXPECT_EQ(OnlyFinding(calibration), "Only 9 boards.");
}

TEST(CalibrationVerdict, OneBoard) {
  BoardCalibration calibration = Good();
  calibration.lens.boards.resize(1);
  calibration.lens.boards[0].tilt_deg = 30;
  const auto findings = JudgeBoards(calibration, kSize);
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(findings[0].reason, "Only 1 board.");
  EXPECT_EQ(findings[1].reason, "Only 1 board is tilted by more than 20 degrees.");
}

// That nothing could be compared is said, not taken for agreement.
TEST(CalibrationVerdict, NothingToCompare) {
  BoardCalibration calibration = Good();
  for (auto& px : calibration.halves->px) px.reset();
  EXPECT_EQ(OnlyFinding(calibration).find("The lenses of two halves of the boards cannot be"), 0u);
  calibration = Good();
  for (auto& px : calibration.splined_difference.px) px.reset();
  EXPECT_EQ(OnlyFinding(calibration).find("The lens model and the splined one cannot be"), 0u);
  calibration = Good();
  for (int& count : calibration.splined.cells.counts) count = 0;
  const auto findings = JudgeBoards(calibration, kSize);
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(findings[2].reason.find("How uncertain the projection is, is not known"), 0u);
}

TEST(CalibrationVerdict, NoBoardsInACorner) {
  BoardCalibration calibration = Good();
  for (int row = 6; row < 9; ++row) {
    for (int column = 9; column < 13; ++column) {
      calibration.lens.cells.counts[row * kFrameColumns + column] = 0;
    }
  }
  EXPECT_EQ(OnlyFinding(calibration), "Hardly any board corners in the frame's lower right.");
}

TEST(CalibrationVerdict, NeverTilted) {
  BoardCalibration calibration = Good();
  for (BoardView& board : calibration.lens.boards) board.tilt_deg = 5;
  EXPECT_EQ(OnlyFinding(calibration), "Only 0 boards are tilted by more than 20 degrees.");
}

TEST(CalibrationVerdict, AllAtOneDistance) {
  BoardCalibration calibration = Good();
  for (BoardView& board : calibration.lens.boards) board.distance_m = 1.5;
  EXPECT_EQ(OnlyFinding(calibration), "All boards stand at one distance, 1.50 to 1.50 m.");
}

TEST(CalibrationVerdict, ResidualsAndOutliers) {
  BoardCalibration calibration = Good();
  calibration.lens.rms_px = 1.2;
  EXPECT_EQ(OnlyFinding(calibration),
            "The residuals are high: RMS 1.20 px, expected below 0.75 px.");
  calibration = Good();
  calibration.lens.outliers = 300;
  EXPECT_EQ(OnlyFinding(calibration), "13.0 % of the corners were refused as outliers.");
  EXPECT_EQ(JudgeBoards(calibration, kSize)[0].severity, Severity::kFail);
}

TEST(CalibrationVerdict, HalvesAndModels) {
  BoardCalibration calibration = Good();
  calibration.halves = Difference(1.5);
  EXPECT_EQ(OnlyFinding(calibration)
                .find("Two halves of the boards give different lenses: up to "
                      "1.50 px"),
            0u);
  calibration = Good();
  calibration.halves.reset();
  EXPECT_EQ(OnlyFinding(calibration), "Too few boards for a cross-validation of two halves.");
  calibration = Good();
  calibration.splined_difference = Difference(0.9);
  EXPECT_EQ(OnlyFinding(calibration).find("The lens model does not describe this lens"), 0u);
}

// Where no board was seen the lenses may part as they like.
TEST(CalibrationVerdict, UnseenPlacesDoNotCount) {
  BoardCalibration calibration = Good();
  for (int i = 0; i < kNodes; i += 3) {
    calibration.lens.cells.counts[i] = calibration.splined.cells.counts[i] = 0;
    calibration.splined_difference.px[i] = 50;
    calibration.splined.uncertainty.sigma_px[i] = std::nullopt;
  }
  EXPECT_TRUE(JudgeBoards(calibration, kSize).empty());
}

TEST(CalibrationVerdict, Uncertain) {
  BoardCalibration calibration = Good();
  for (auto& sigma : calibration.splined.uncertainty.sigma_px) sigma = 2;
  EXPECT_EQ(OnlyFinding(calibration),
            "The projection is uncertain by more than 1 px at 100 % of the places where boards "
            "were seen.");
}

}  // namespace
}  // namespace insitu
