// SPDX-License-Identifier: GPL-3.0-or-later
// How well a board solution knows its lens, read from the optimization inputs that mrcal keeps in
// the .cameramodel itself.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace insitu {

// Grids over the frame go row by row.
constexpr int kFrameColumns = 13, kFrameRows = 9;

struct ProjectionUncertainty {
  int columns = 0, rows = 0;
  // At the centres of the same cells as FrameCells', at infinity, worst direction; nullopt beyond a
  // splined model.
  std::vector<std::optional<double>> sigma_px;
  double center_px = 0;  // at the image centre
};

// The corners used, by equal cells of the frame.
struct FrameCells {
  int columns = 0, rows = 0;
  std::vector<int> counts;
  std::vector<double> mean_x_px, mean_y_px;  // residual, projected - found; 0 in an empty cell
};

struct BoardView {
  std::string photo;  // file name
  int corners = 0, outliers = 0;
  double rms_px = 0, worst_px = 0;
  double tilt_deg = 0;    // of the board's plane against the image plane
  double distance_m = 0;  // camera to the board's centre
};

struct LensAssessment {
  int points = 0, outliers = 0;  // corners used, corners refused
  double rms_px = 0;  // sqrt(sum |residual|^2 / points); mrcal prints it per coordinate, / sqrt(2)
  double weighted_rms_px = 0;  // with mrcal's weights of the corners, as its own figures are
  double worst_px = 0;         // the largest |residual| of the points used
  bool is_regularised = false;
  std::vector<double> board_warp_m;  // mrcal's two coefficients of the board's curvature
  ProjectionUncertainty uncertainty;
  FrameCells cells;
  std::vector<BoardView> boards;
  // Of the intrinsics in mrcal's order; regularisation holds the estimate but adds no noise;
  // nullopt for splined models. In correlation with the boards' poses: what a photograph with a
  // free pose needs.
  std::optional<Eigen::MatrixXd> intrinsics_covariance;
};

// Whether a .cameramodel holds what AssessLens needs. Throws InputError: unreadable.
bool HoldsSolution(const std::filesystem::path& model);

// Runs mrcal's Python; its output and log are left in `folder`. `corners`, the table the solution
// was made from, names the boards' photos; if empty they are numbered. `while_running` is called
// meanwhile. Throws InputError.
LensAssessment AssessLens(const std::filesystem::path& model, const std::filesystem::path& folder,
                          const std::filesystem::path& corners = {},
                          const std::function<void()>& while_running = {});

}  // namespace insitu
