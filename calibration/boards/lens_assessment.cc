// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/lens_assessment.h"

#include <algorithm>

#include "calibration/boards/board_scripts.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/program/external_program.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

std::vector<std::optional<double>> NumbersOrNull(const JsonNode& node) {
  std::vector<std::optional<double>> numbers;
  for (const JsonNode& item : node.Items()) {
    numbers.push_back(item.IsNull() ? std::nullopt : std::optional(item.Number()));
  }
  return numbers;
}

FrameCells CellsOf(const JsonNode& node) {
  FrameCells cells{kFrameColumns,
                   kFrameRows,
                   {},
                   node.At("mean_x_px").Numbers(),
                   node.At("mean_y_px").Numbers()};
  for (const JsonNode& count : node.At("counts").Items()) cells.counts.push_back(count.Integer());
  return cells;
}

BoardView BoardOf(const JsonNode& node) {
  return {node.At("photo").Text(),       node.At("corners").Integer(),
          node.At("outliers").Integer(), node.At("rms_px").Number(),
          node.At("worst_px").Number(),  node.At("tilt_deg").Number(),
          node.At("distance_m").Number()};
}

LensAssessment AssessmentOf(const JsonNode& node) {
  LensAssessment lens;
  lens.points = node.At("points").Integer();
  lens.outliers = node.At("outliers").Integer();
  lens.rms_px = node.At("rms_px").Number();
  lens.weighted_rms_px = node.At("weighted_rms_px").Number();
  lens.worst_px = node.At("worst_px").Number();
  lens.is_regularised = node.At("regularised").Boolean();
  lens.board_warp_m = node.At("board_warp_m").Numbers();
  lens.uncertainty = {kFrameColumns, kFrameRows, NumbersOrNull(node.At("sigma_px")),
                      node.At("center_px").Number()};
  lens.cells = CellsOf(node.At("cells"));
  for (const JsonNode& board : node.At("boards").Items()) lens.boards.push_back(BoardOf(board));
  if (const auto covariance = node.Find("intrinsics_covariance")) {
    lens.intrinsics_covariance = covariance->Matrix();
  }
  return lens;
}

}  // namespace

bool HoldsSolution(const fs::path& model) {
  return ReadWhole(model).find("'optimization_inputs'") != std::string::npos;
}

LensAssessment AssessLens(const fs::path& model, const fs::path& folder, const fs::path& corners,
                          const std::function<void()>& while_running) {
  fs::create_directories(folder);
  const fs::path output = folder / (model.stem().string() + ".json");
  std::vector<std::string> command = {kPython,
                                      "-c",
                                      kAssessCalibration,
                                      fs::absolute(model).string(),
                                      std::to_string(kFrameColumns),
                                      std::to_string(kFrameRows)};
  if (!corners.empty()) command.push_back(fs::absolute(corners).string());
  RunExternal({.command = command,
               .package = "python3-mrcal",
               .folder = folder,
               .output = output,
               .log = folder / (model.stem().string() + "_assessment.log"),
               .while_running = while_running});
  return AssessmentOf(JsonNode::Load(output));
}

}  // namespace insitu
