// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/board.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exiv2/exiv2.hpp>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "calibration/error.h"
#include "calibration/external_program.h"
#include "calibration/json_file.h"
#include "calibration/photograph.h"
#include "calibration/whole_file.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr int kFewestBoards = 3;
constexpr int kGridColumns = 13, kGridRows = 9;  // of the uncertainty over the frame
constexpr char kCorners[] = "corners.vnl";
constexpr char kPython[] = "/usr/bin/python3";  // Debian's own, which has mrcal
const std::string kRunSeeded = INSITU_CALIBRATION_FOLDER "/run_seeded.py";
const std::string kProjectionUncertainty = INSITU_CALIBRATION_FOLDER "/projection_uncertainty.py";
constexpr char kMrcalPackage[] = "python3-mrcal";
constexpr char kPhotos[] = "photos/";
constexpr char kPhotosGlob[] = "photos/*";  // mrcal takes one pattern a camera

void CheckSquare(const Board& board) {
  if (board.interior_corners_x == board.interior_corners_y) return;
  throw InputError(board.path, "a board of " + std::to_string(board.interior_corners_x) + "x" +
                                   std::to_string(board.interior_corners_y) +
                                   " interior corners, expected a square one for mrgingham");
}

// ---- the photographs -----------------------------------------------------------------------

Eigen::Vector2i CommonSize(const std::vector<fs::path>& photos) {
  Eigen::Vector2i size = ReadPhotographSize(photos.front());
  for (const fs::path& photo : photos) {
    const Eigen::Vector2i other = ReadPhotographSize(photo);
    if (other == size) continue;
    std::ostringstream message;
    message << "is " << other.x() << "x" << other.y() << " px, expected " << size.x() << "x"
            << size.y() << " px as " << photos.front().filename().string();
    throw InputError(photo, message.str());
  }
  return size;
}

// The focal length that would give the same field of view on 35 mm film [mm], from EXIF.
std::optional<double> Focal35mm(const fs::path& photo) {
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // cameras' own oddities are not the user's
  try {
    const auto image = Exiv2::ImageFactory::open(photo.string());
    image->readMetadata();
    const Exiv2::ExifData& exif = image->exifData();
    const auto entry = exif.findKey(Exiv2::ExifKey("Exif.Photo.FocalLengthIn35mmFilm"));
    if (entry == exif.end() || entry->toFloat() <= 0) return std::nullopt;
    return entry->toFloat();
  } catch (const Exiv2::Error&) {  // a format without metadata
    return std::nullopt;
  }
}

double StartFocal(const fs::path& photo, const Eigen::Vector2i& size) {
  const double film_diagonal = std::hypot(36.0, 24.0);  // [mm]
  const double diagonal = size.cast<double>().norm();
  if (const auto focal = Focal35mm(photo)) return *focal / film_diagonal * diagonal;
  return size.x() / 2.0 / std::tan(25 * std::numbers::pi / 180);
}

// ---- mrcal's programs ----------------------------------------------------------------------

// Links to the photos in one new folder, so that one pattern names them all and what mrcal stores
// names no folder of ours.
void LinkPhotos(const std::vector<fs::path>& photos, const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder / kPhotos);
  for (const fs::path& photo : photos) {
    fs::create_symlink(fs::absolute(photo), folder / kPhotos / photo.filename());
  }
}

// mrgingham's worker processes report in the order in which they finish.
void SortByPhoto(const fs::path& corners) {
  std::istringstream stream(ReadWhole(corners));
  std::string head, line;
  std::map<std::string, std::string> lines_of_photo;
  while (std::getline(stream, line)) {
    if (line.starts_with('#')) {
      head += line + "\n";
    } else {
      lines_of_photo[line.substr(0, line.find(' '))] += line + "\n";
    }
  }
  for (const auto& [photo, lines] : lines_of_photo) head += lines;
  WriteWhole(corners, head);
}

void FindCorners(const Board& board, const fs::path& folder) {
  RunExternal({.command = {"mrgingham", "--jobs", "2", "--gridn",
                           std::to_string(board.interior_corners_x), kPhotosGlob},
               .package = "mrgingham",
               .folder = folder,
               .output = folder / kCorners,
               .log = folder / "mrgingham.log"});
  SortByPhoto(folder / kCorners);
}

// A line is "photo x y level"; "-" stands for a corner that was not found.
std::set<std::string> PhotosWithCorners(const fs::path& corners) {
  std::istringstream stream(ReadWhole(corners));
  std::set<std::string> photos;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    std::string photo, x;
    if (!line.starts_with('#') && cells >> photo >> x && x != "-") photos.insert(photo);
  }
  return photos;
}

void CountBoards(const std::vector<fs::path>& photos, const fs::path& folder,
                 BoardCalibration* result) {
  const std::set<std::string> found = PhotosWithCorners(folder / kCorners);
  result->board_photos = static_cast<int>(photos.size());
  result->boards_found = static_cast<int>(found.size());
  for (const fs::path& photo : photos) {
    const std::string name = photo.filename().string();
    if (!found.contains(kPhotos + name)) result->not_found.push_back(name);
  }
  if (result->boards_found >= kFewestBoards) return;
  throw InputError(photos.front().parent_path(),
                   "whole boards found in " + std::to_string(found.size()) + " of " +
                       std::to_string(photos.size()) + " photos, expected at least " +
                       std::to_string(kFewestBoards));
}

// mrcal's model as it is, but for the comment that holds the date and the command line.
void CopyModel(const fs::path& source, const fs::path& target) {
  std::istringstream stream(ReadWhole(source));
  std::string model = "# made by mrcal-calibrate-cameras\n";
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("# generated on")) model += line + "\n";
  }
  WriteWhole(target, model);
}

std::string Digits(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

void SolveLens(const Board& board, const std::string& lens_model, double focal_px,
               const fs::path& folder, const fs::path& model) {
  const fs::path made = folder / "made";
  fs::create_directory(made);
  const fs::path log = folder / (model.stem().string() + ".log");
  RunExternal(
      {.command = {kPython, kRunSeeded, "mrcal-calibrate-cameras", "--corners-cache", kCorners,
                   "--lensmodel", lens_model, "--focal", Digits(focal_px), "--object-spacing",
                   Digits(board.square_m), "--object-width-n",
                   std::to_string(board.interior_corners_x), "--outdir", "made", kPhotosGlob},
       .package = kMrcalPackage,
       .folder = folder,
       .output = log,
       .log = log});
  CopyModel(made / "camera-0.cameramodel", model);
  fs::remove_all(made);
}

JsonNode Assess(const fs::path& model, const fs::path& folder) {
  const fs::path output = folder / (model.stem().string() + ".json");
  RunExternal({.command = {kPython, kProjectionUncertainty, fs::absolute(model).string(),
                           std::to_string(kGridColumns), std::to_string(kGridRows)},
               .package = kMrcalPackage,
               .folder = folder,
               .output = output,
               .log = folder / (model.stem().string() + "_uncertainty.log")});
  return JsonNode::Load(output);
}

ProjectionUncertainty UncertaintyOf(const JsonNode& assessed) {
  return {kGridColumns, kGridRows, assessed.At("sigma_px").Numbers(),
          assessed.At("center_px").Number()};
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

// ---- board.txt -----------------------------------------------------------------------------

template <typename Number>
Number PositiveNumber(const fs::path& path, int line, const std::string& key,
                      const std::string& text) {
  std::istringstream stream(text);
  Number number = 0;
  if (!(stream >> number) || !stream.eof() || !(number > 0) || !std::isfinite(number)) {
    throw InputError(path, line, "\"" + text + "\" as " + key + ", expected a positive number");
  }
  return number;
}

struct BoardLine {
  int line;
  std::string value;
};

std::map<std::string, BoardLine> ReadBoardLines(const fs::path& path) {
  static const std::set<std::string> kKeys = {"type", "interior_corners_x", "interior_corners_y",
                                              "square_m", "note"};
  std::istringstream stream(ReadWhole(path));
  std::map<std::string, BoardLine> lines;
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    std::istringstream words(text);
    std::string key, value;
    if (!(words >> key) || key.starts_with('#')) continue;
    std::getline(words >> std::ws, value);
    value.erase(value.find_last_not_of(" \t\r") + 1);
    if (!kKeys.contains(key)) {
      throw InputError(path, number,
                       "\"" + key +
                           "\" is unknown, expected type, interior_corners_x, "
                           "interior_corners_y, square_m or note");
    }
    if (!lines.emplace(key, BoardLine{number, value}).second) {
      throw InputError(path, number, key + " stands twice, expected it once");
    }
  }
  return lines;
}

}  // namespace

Board ReadBoard(const fs::path& path) {
  const std::map<std::string, BoardLine> lines = ReadBoardLines(path);
  for (const char* key : {"type", "interior_corners_x", "interior_corners_y", "square_m"}) {
    if (!lines.contains(key)) throw InputError(path, std::string(key) + " is missing");
  }
  const BoardLine& type = lines.at("type");
  if (type.value != "chessboard") {
    throw InputError(path, type.line, "\"" + type.value + "\" as type, expected chessboard");
  }
  const auto number = [&]<typename Number>(const std::string& key, Number& value) {
    value = PositiveNumber<Number>(path, lines.at(key).line, key, lines.at(key).value);
  };
  Board board;
  board.path = path;
  number("interior_corners_x", board.interior_corners_x);
  number("interior_corners_y", board.interior_corners_y);
  number("square_m", board.square_m);
  return board;
}

BoardCalibration CalibrateFromBoards(const std::vector<fs::path>& board_photos, const Board& board,
                                     const fs::path& output_model,
                                     const BoardCalibrationOptions& options) {
  INSITU_CHECK(!board_photos.empty());
  CheckSquare(board);
  const Eigen::Vector2i size = CommonSize(board_photos);
  const double focal_px =
      options.focal_px > 0 ? options.focal_px : StartFocal(board_photos.front(), size);
  const fs::path folder = fs::absolute(output_model).parent_path() / "boards";
  const fs::path lean = folder / "lean.cameramodel", splined = folder / "splined.cameramodel";
  LinkPhotos(board_photos, folder);
  FindCorners(board, folder);

  BoardCalibration result;
  CountBoards(board_photos, folder, &result);
  SolveLens(board, options.lens_model, focal_px, folder, lean);
  result.lens_model = options.lens_model;
  result.splined_lens_model = SplinedLensModel(ReadCamera(lean));
  SolveLens(board, result.splined_lens_model, focal_px, folder, splined);

  const JsonNode assessed = Assess(lean, folder);
  result.points = assessed.At("points").Integer();
  result.outliers = assessed.At("outliers").Integer();
  result.rms_px = assessed.At("rms_px").Number();
  result.worst_px = assessed.At("worst_px").Number();
  result.uncertainty = UncertaintyOf(assessed);
  result.splined_uncertainty = UncertaintyOf(Assess(splined, folder));
  result.model = output_model;
  WriteWhole(output_model, ReadWhole(lean));
  return result;
}

std::string BoardCalibration::BriefReport() const {
  char text[256];
  std::snprintf(text, sizeof(text),
                "%s: %d of %d boards, %d corners, %d outliers, RMS %.3f px, worst %.2f px, "
                "uncertainty at the centre %.3f px (splined %.3f px)",
                lens_model.c_str(), boards_found, board_photos, points, outliers, rms_px, worst_px,
                uncertainty.center_px, splined_uncertainty.center_px);
  return text;
}

}  // namespace insitu
