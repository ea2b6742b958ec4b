// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board_calibration.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "calibration/boards/board_corners.h"
#include "calibration/boards/board_scripts.h"
#include "calibration/boards/find_board.h"
#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/external_program.h"
#include "calibration/program/program.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr int kFewestBoards = 3;
constexpr char kPhotos[] = "photos/";

// ---- the photographs -----------------------------------------------------------------------

Eigen::Vector2i CommonSize(const std::vector<fs::path>& photos) {
  const Eigen::Vector2i size = ReadPhotographSize(photos.front());
  for (const fs::path& photo : photos) {
    const Eigen::Vector2i other = ReadPhotographSize(photo);
    if (other == size) continue;
    std::ostringstream message;
    message << "is " << other.x() << "x" << other.y() << " px, expected " << size.x() << "x"
            << size.y() << " px as " << photos.front().filename().string()
            << "; boards of another camera or another format belong in a folder of their own";
    throw InputError(photo, message.str());
  }
  return size;
}

double StartFocal(const fs::path& photo) {
  const ExifCamera exif = ReadExifCamera(photo);
  if (const auto focal_px = exif.FocalPx()) return *focal_px;
  return exif.size.x() / 2.0 / std::tan(25 * std::numbers::pi / 180);
}

// What a photo is called within boards/: a corner table is split at blanks, and names have some.
std::string LinkName(const std::vector<fs::path>& photos, size_t i) {
  return Formatted("%06zu", i + 1) + photos[i].extension().string();
}

// Links to the photos in one new folder, so that one pattern names them all and what mrcal stores
// names no folder of ours.
void LinkPhotos(const std::vector<fs::path>& photos, const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder / kPhotos);
  for (size_t i = 0; i < photos.size(); ++i) {
    fs::create_symlink(fs::absolute(photos[i]), folder / kPhotos / LinkName(photos, i));
  }
}

// The photos' own names for those of their links.
void NamePhotos(const std::vector<fs::path>& photos, LensAssessment* lens) {
  std::map<std::string, std::string> name_of_link;
  for (size_t i = 0; i < photos.size(); ++i) {
    name_of_link[LinkName(photos, i)] = photos[i].filename().string();
  }
  for (BoardView& board : lens->boards) {
    const auto name = name_of_link.find(board.photo);
    if (name != name_of_link.end()) board.photo = name->second;
  }
}

// ---- the boards ----------------------------------------------------------------------------

// Most often board.txt counts squares instead of the corners between them.
std::string AdviceOnCounts(const std::vector<fs::path>& photos, const Board& board) {
  if (board.pattern == BoardPattern::kCharuco) {
    return "; each photo must show several markers, sharp, and board.txt must name the dictionary "
           "and "
           "the counts with which the board was drawn";
  }
  if (board.pattern != BoardPattern::kChessboard) {
    return "; each photo must show all circles, sharp, and board.txt must count them";
  }
  const Board fewer{board.points_x - 1, board.points_y - 1, board.spacing_m, ""};
  if (std::min(fewer.points_x, fewer.points_y) < 3) return "";
  for (size_t i = 0; i < std::min<size_t>(photos.size(), 3); ++i) {
    if (!FindBoard(ReadPhotograph(photos[i]).linear, fewer)) continue;
    return "; " + photos[i].filename().string() + " shows a board of " +
           std::to_string(fewer.points_x) + "x" + std::to_string(fewer.points_y) +
           " interior corners: board.txt must count interior corners, not squares";
  }
  return "; each photo must show the whole board with its white border, sharp, and board.txt must "
         "count its interior corners";
}

constexpr size_t kFewPhotos = 8;
constexpr char kHowManyPhotos[] =
    "; a lens needs 20 to 40 photos of the board: near, tilted, and into every corner of the frame";

void CountBoards(const std::vector<fs::path>& photos, const Board& board, const fs::path& corners,
                 BoardCalibration* result) {
  const std::vector<std::string> names = PhotosWithBoard(corners);
  const std::set<std::string> found(names.begin(), names.end());
  result->board_photos = static_cast<int>(photos.size());
  result->boards_found = static_cast<int>(found.size());
  for (size_t i = 0; i < photos.size(); ++i) {
    if (found.contains(kPhotos + LinkName(photos, i))) continue;
    result->not_found.push_back(photos[i].filename().string());
  }
  if (result->boards_found >= kFewestBoards) return;
  throw InputError(photos.front().parent_path(),
                   "whole boards found in " + std::to_string(found.size()) + " of " +
                       std::to_string(photos.size()) + " photos, expected at least " +
                       std::to_string(kFewestBoards) +
                       (found.empty() ? AdviceOnCounts(photos, board) : "") +
                       (photos.size() < kFewPhotos ? kHowManyPhotos : ""));
}

// ---- mrcal's solutions ---------------------------------------------------------------------

// mrcal's model as it is, but for the comment that holds the date and the command line.
void CopyModel(const fs::path& source, const fs::path& target) {
  std::istringstream stream(ReadWhole(source));
  std::string model = "# made by mrcal-calibrate-cameras\n";
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("# generated on")) model += line + "\n";
  }
  WriteWhole(target, model);
}

struct Solver {
  Board board;
  double focal_px;
  fs::path folder;
  std::function<void()> while_running;  // mrcal's programs

  // Solves from a corner table in `folder`; the model is named folder/NAME.cameramodel.
  fs::path Solve(const std::string& lens_model, const fs::path& corners,
                 const std::string& name) const;
};

fs::path Solver::Solve(const std::string& lens_model, const fs::path& corners,
                       const std::string& name) const {
  const fs::path made = folder / "made", log = folder / (name + ".log");
  fs::create_directory(made);
  RunExternal({.command = {kPython, "-c", kRunSeeded, "mrcal-calibrate-cameras", "--corners-cache",
                           corners.filename().string(), "--lensmodel", lens_model, "--focal",
                           Formatted("%.17g", focal_px), "--object-spacing",
                           Formatted("%.17g", board.spacing_m), "--object-width-n",
                           std::to_string(board.points_x), "--object-height-n",
                           std::to_string(board.points_y), "--outdir", "made", "photos/*"},
               .package = "python3-mrcal",
               .folder = folder,
               .output = log,
               .log = log,
               .while_running = while_running});
  const fs::path model = folder / (name + ".cameramodel");
  CopyModel(made / "camera-0.cameramodel", model);
  fs::remove_all(made);
  return model;
}

// About three control points for 100 px of a small photograph: dense enough for any usual lens,
// and solved in seconds.
std::string SplinedLensModel(const Camera& lean) {
  constexpr int kColumns = 12;
  double half_x = 0, half_y = 0;  // [rad]
  for (const double x : {-0.5, lean.width() - 0.5}) {
    for (const double y : {-0.5, lean.height() - 0.5}) {
      const Eigen::Vector3d sight = lean.Unproject({x, y});
      half_x = std::max(half_x, std::atan2(std::abs(sight.x()), sight.z()));
      half_y = std::max(half_y, std::atan2(std::abs(sight.y()), sight.z()));
    }
  }
  const double fov_x_deg = 1.1 * 2 * half_x * 180 / std::numbers::pi;
  const int rows = 1 + static_cast<int>(std::ceil(kColumns * half_y / half_x));
  return "LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=" + std::to_string(kColumns) +
         "_Ny=" + std::to_string(rows) +
         "_fov_x_deg=" + std::to_string(static_cast<int>(std::ceil(fov_x_deg)));
}

// Where a lens is well known its projection counts much.
std::vector<double> WeightsOf(const ProjectionUncertainty& uncertainty) {
  std::vector<double> weights;
  for (const auto& sigma : uncertainty.sigma_px) {
    weights.push_back(sigma && *sigma > 0 ? 1 / (*sigma * *sigma) : 0);
  }
  return weights;
}

ProjectionDifference Difference(const fs::path& a, const fs::path& b,
                                const ProjectionUncertainty& trust) {
  return CompareLenses(ReadCamera(a), ReadCamera(b), trust.columns, trust.rows, WeightsOf(trust));
}

// Two lenses that know nothing of each other: what they disagree about, the calibration does not
// know, whatever its own estimate of its errors says.
std::optional<ProjectionDifference> CrossValidate(const Solver& solver,
                                                  const BoardCalibration& calibration,
                                                  const fs::path& corners) {
  if (calibration.boards_found < 2 * kFewestBoards) return std::nullopt;
  std::vector<fs::path> models;
  for (const int part : {0, 1}) {
    const std::string name = "half_" + std::to_string(part + 1);
    const fs::path half = solver.folder / (name + ".vnl");
    WriteHalf(corners, part, half);
    models.push_back(solver.Solve(calibration.lens_model, half, name));
  }
  return Difference(models[0], models[1], calibration.lens.uncertainty);
}

}  // namespace

void BoardCalibrationOptions::Check() const {
  INSITU_CHECK(lens_model.starts_with("LENSMODEL_"));
  INSITU_CHECK(focal_px >= 0 && std::isfinite(focal_px));
}

BoardCalibration CalibrateFromBoards(const std::vector<fs::path>& board_photos, const Board& board,
                                     const fs::path& output_model,
                                     const BoardCalibrationOptions& options) {
  INSITU_CHECK(!board_photos.empty());
  options.Check();
  CommonSize(board_photos);
  std::optional<Progress> progress;  // after that of the boards
  const auto show = [&] { progress->Show(); };
  const Solver solver{board,
                      options.focal_px > 0 ? options.focal_px : StartFocal(board_photos.front()),
                      fs::absolute(output_model).parent_path() / "boards", show};
  LinkPhotos(board_photos, solver.folder);
  const fs::path corners = FindBoardCorners(board, solver.folder);

  BoardCalibration result;
  CountBoards(board_photos, board, corners, &result);
  result.lens_model = options.lens_model;
  progress.emplace("solving for the lens, step 1 of 4", 0);
  const fs::path lean = solver.Solve(result.lens_model, corners, "lean");
  result.splined_lens_model = SplinedLensModel(ReadCamera(lean));
  progress->Next("solving for the splined lens, step 2 of 4");
  const fs::path splined = solver.Solve(result.splined_lens_model, corners, "splined");

  progress->Next("assessing both, step 3 of 4");
  result.lens = AssessLens(lean, solver.folder, corners, show);
  result.splined = AssessLens(splined, solver.folder, corners, show);
  NamePhotos(board_photos, &result.lens);
  NamePhotos(board_photos, &result.splined);
  result.splined_difference = Difference(lean, splined, result.splined.uncertainty);
  progress->Next("comparing two halves of the boards, step 4 of 4");
  result.halves = CrossValidate(solver, result, corners);
  result.model = output_model;
  WriteWhole(output_model, ReadWhole(lean));
  return result;
}

std::string BoardCalibration::BriefReport() const {
  return Formatted(
      "%s: %d of %d boards, %d corners, %d outliers, RMS %.3f px, worst %.2f px, "
      "uncertainty at the centre %.3f px (splined %.3f px)",
      lens_model.c_str(), boards_found, board_photos, lens.points, lens.outliers, lens.rms_px,
      lens.worst_px, lens.uncertainty.center_px, splined.uncertainty.center_px);
}

}  // namespace insitu
