// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board_corners.h"

#include <algorithm>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/external_program.h"
#include "calibration/program/program.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr char kCorners[] = "corners.vnl";

cv::Mat GreyCodes(const Raster& linear) {
  cv::Mat grey(linear.height, linear.width, CV_8U);
  for (int y = 0; y < linear.height; ++y) {
    for (int x = 0; x < linear.width; ++x) {
      const double light = std::clamp(linear.Rgb(x, y).mean(), 0.0, 1.0);
      grey.at<uchar>(y, x) = cv::saturate_cast<uchar>(255 * SrgbFromLinear(light));
    }
  }
  return grey;
}

// The older finder sees some boards that the newer one does not, a little less sharply.
bool FindByQuads(const cv::Mat& grey, const cv::Size& size, std::vector<cv::Point2f>* corners) {
  if (!cv::findChessboardCorners(grey, size, *corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE)) {
    return false;
  }
  double closest = 1e9;
  for (size_t i = 1; i < corners->size(); ++i) {
    closest = std::min(closest, cv::norm((*corners)[i] - (*corners)[i - 1]));
  }
  const int half_window = std::max(2, static_cast<int>(closest / 3));
  cv::cornerSubPix(grey, *corners, {half_window, half_window}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-4});
  return true;
}

bool FindBySectors(const cv::Mat& grey, const cv::Size& size, std::vector<cv::Point2f>* corners) {
  return cv::findChessboardCornersSB(grey, size, *corners, cv::CALIB_CB_ACCURACY) ||
         cv::findChessboardCornersSB(grey, size, *corners,
                                     cv::CALIB_CB_ACCURACY | cv::CALIB_CB_EXHAUSTIVE);
}

// A board cannot be seen from behind: each row is turned round if x to y turns the wrong way.
void TurnRight(int columns, std::vector<cv::Point2f>* corners) {
  const cv::Point2f x = (*corners)[columns - 1] - (*corners)[0];
  const cv::Point2f y = (*corners)[corners->size() - columns] - (*corners)[0];
  if (x.cross(y) > 0) return;
  for (auto row = corners->begin(); row != corners->end(); row += columns) {
    std::reverse(row, row + columns);
  }
}

std::string Line(const std::string& photo, const Eigen::Vector2d& corner) {
  return photo + Formatted(" %.6f %.6f 0\n", corner.x(), corner.y());
}

std::vector<fs::path> PhotosIn(const fs::path& folder) {
  std::vector<fs::path> photos;
  for (const auto& entry : fs::directory_iterator(folder / "photos")) {
    photos.push_back(entry.path());
  }
  std::sort(photos.begin(), photos.end());
  return photos;
}

void FindRectangularBoards(const Board& board, const fs::path& folder) {
  const std::vector<fs::path> photos = PhotosIn(folder);
  Progress progress("finding boards", static_cast<int>(photos.size()));
  std::string table = "# filename x y level\n";
  for (const fs::path& path : photos) {
    const std::string photo = "photos/" + path.filename().string();
    const auto corners = FindChessboard(ReadPhotograph(path).linear, board);
    if (!corners) table += photo + " - -\n";
    if (corners) {
      for (const Eigen::Vector2d& corner : *corners) table += Line(photo, corner);
    }
    progress.Step();
  }
  WriteWhole(folder / kCorners, table);
}

// The comments and, by photo, the lines of a corner table.
struct CornerTable {
  std::string head;
  std::map<std::string, std::string> lines_of_photo;
};

CornerTable ReadCornerTable(const fs::path& corners) {
  std::istringstream stream(ReadWhole(corners));
  CornerTable table;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) {
      table.head += line + "\n";
    } else {
      table.lines_of_photo[line.substr(0, line.find(' '))] += line + "\n";
    }
  }
  return table;
}

bool IsFound(const std::string& photo, const std::string& lines) {
  return lines.compare(photo.size(), 3, " - ") != 0;
}

// mrgingham's worker processes report in the order in which they finish.
void SortByPhoto(const fs::path& corners) {
  const CornerTable table = ReadCornerTable(corners);
  std::string sorted = table.head;
  for (const auto& [photo, lines] : table.lines_of_photo) sorted += lines;
  WriteWhole(corners, sorted);
}

}  // namespace

std::optional<std::vector<Eigen::Vector2d>> FindChessboard(const Raster& linear,
                                                           const Board& board) {
  const cv::Mat grey = GreyCodes(linear);
  const cv::Size size(board.interior_corners_x, board.interior_corners_y);
  std::vector<cv::Point2f> found;
  if (!FindBySectors(grey, size, &found) && !FindByQuads(grey, size, &found)) return std::nullopt;
  TurnRight(size.width, &found);
  std::vector<Eigen::Vector2d> corners;
  corners.reserve(found.size());
  for (const cv::Point2f& corner : found) corners.emplace_back(corner.x, corner.y);
  return corners;
}

fs::path FindBoardCorners(const Board& board, const fs::path& folder) {
  if (board.interior_corners_x != board.interior_corners_y) {
    FindRectangularBoards(board, folder);
    return folder / kCorners;
  }
  const std::vector<fs::path> photos = PhotosIn(folder);
  Progress progress("finding boards", static_cast<int>(photos.size()));
  size_t done = 0;
  RunExternal({.command = {"mrgingham", "--jobs", "2", "--gridn",
                           std::to_string(board.interior_corners_x), "photos/*"},
               .package = "mrgingham",
               .folder = folder,
               .output = folder / kCorners,
               .log = folder / "mrgingham.log",
               .while_running = [&] {
                 const size_t found = ReadCornerTable(folder / kCorners).lines_of_photo.size();
                 for (; done < found; ++done) progress.Step();
                 progress.Show();
               }});
  SortByPhoto(folder / kCorners);
  return folder / kCorners;
}

std::vector<std::string> PhotosWithBoard(const fs::path& corners) {
  std::vector<std::string> photos;
  for (const auto& [photo, lines] : ReadCornerTable(corners).lines_of_photo) {
    if (IsFound(photo, lines)) photos.push_back(photo);
  }
  return photos;
}

void WriteHalf(const fs::path& corners, int part, const fs::path& half) {
  const CornerTable table = ReadCornerTable(corners);
  std::string lines_of_half = table.head;
  int number = 0;
  for (const auto& [photo, lines] : table.lines_of_photo) {
    if (IsFound(photo, lines) && number++ % 2 == part) lines_of_half += lines;
  }
  WriteWhole(half, lines_of_half);
}

}  // namespace insitu
