// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/find_board.h"

#include <algorithm>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

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

BoardPoints AllSeen(const std::vector<cv::Point2f>& found) {
  BoardPoints points;
  points.reserve(found.size());
  for (const cv::Point2f& point : found) points.emplace_back(Eigen::Vector2d(point.x, point.y));
  return points;
}

std::optional<BoardPoints> FindChessboard(const cv::Mat& grey, const Board& board) {
  const cv::Size size(board.points_x, board.points_y);
  std::vector<cv::Point2f> found;
  if (!FindBySectors(grey, size, &found) && !FindByQuads(grey, size, &found)) return std::nullopt;
  TurnRight(size.width, &found);
  return AllSeen(found);
}

// ---- circles -------------------------------------------------------------------------------

// Blobs up to the size that a board filling the photograph has.
cv::Ptr<cv::FeatureDetector> BlobDetector(const cv::Mat& grey, int circles, uchar color) {
  cv::SimpleBlobDetector::Params params;
  params.blobColor = color;
  params.minArea = 20;
  params.maxArea = static_cast<float>(grey.total()) / static_cast<float>(circles);
  params.minDistBetweenBlobs = 4;
  return cv::SimpleBlobDetector::create(params);
}

std::optional<std::vector<cv::Point2f>> FindCircles(const cv::Mat& grey, const cv::Size& size,
                                                    int flags) {
  std::vector<cv::Point2f> found;
  for (const uchar color : {uchar{0}, uchar{255}}) {
    const auto detector = BlobDetector(grey, size.area(), color);
    for (const int clustering : {0, static_cast<int>(cv::CALIB_CB_CLUSTERING)}) {
      if (cv::findCirclesGrid(grey, size, found, flags | clustering, detector)) return found;
    }
  }
  return std::nullopt;
}

std::optional<BoardPoints> FindSymmetricCircles(const cv::Mat& grey, const Board& board) {
  auto found = FindCircles(grey, {board.points_x, board.points_y}, cv::CALIB_CB_SYMMETRIC_GRID);
  if (!found) return std::nullopt;
  TurnRight(board.points_x, &*found);
  return AllSeen(*found);
}

// Circle j of row i stands in column 2 j + i % 2 of the grid.
std::optional<BoardPoints> FindAsymmetricCircles(const cv::Mat& grey, const Board& board) {
  const int in_row = board.points_x / 2;
  const auto found = FindCircles(grey, {in_row, board.points_y}, cv::CALIB_CB_ASYMMETRIC_GRID);
  if (!found) return std::nullopt;
  BoardPoints points(static_cast<size_t>(board.points_x) * board.points_y);
  for (int i = 0; i < board.points_y; ++i) {
    for (int j = 0; j < in_row; ++j) {
      const cv::Point2f& center = (*found)[static_cast<size_t>(i) * in_row + j];
      points[static_cast<size_t>(i) * board.points_x + 2 * j + i % 2] = {center.x, center.y};
    }
  }
  return points;
}

// ---- ChArUco -------------------------------------------------------------------------------

int DictionaryOf(const Board& board) {
  static const std::map<std::string, int> dictionaries = {
      {"DICT_4X4_50", cv::aruco::DICT_4X4_50},
      {"DICT_4X4_100", cv::aruco::DICT_4X4_100},
      {"DICT_4X4_250", cv::aruco::DICT_4X4_250},
      {"DICT_4X4_1000", cv::aruco::DICT_4X4_1000},
      {"DICT_5X5_50", cv::aruco::DICT_5X5_50},
      {"DICT_5X5_100", cv::aruco::DICT_5X5_100},
      {"DICT_5X5_250", cv::aruco::DICT_5X5_250},
      {"DICT_5X5_1000", cv::aruco::DICT_5X5_1000},
      {"DICT_6X6_50", cv::aruco::DICT_6X6_50},
      {"DICT_6X6_100", cv::aruco::DICT_6X6_100},
      {"DICT_6X6_250", cv::aruco::DICT_6X6_250},
      {"DICT_6X6_1000", cv::aruco::DICT_6X6_1000},
      {"DICT_7X7_50", cv::aruco::DICT_7X7_50},
      {"DICT_7X7_100", cv::aruco::DICT_7X7_100},
      {"DICT_7X7_250", cv::aruco::DICT_7X7_250},
      {"DICT_7X7_1000", cv::aruco::DICT_7X7_1000},
      {"DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL}};
  const auto found = dictionaries.find(board.dictionary);
  if (found != dictionaries.end()) return found->second;
  throw InputError(board.path, "\"" + board.dictionary +
                                   "\" as dictionary, expected one of OpenCV's, as DICT_5X5_100");
}

cv::Ptr<cv::aruco::CharucoBoard> CharucoOf(const Board& board) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(DictionaryOf(board));
  const int squares = (board.points_x + 1) * (board.points_y + 1);
  if (squares / 2 > dictionary->bytesList.rows) {
    throw InputError(board.path, board.dictionary + " has " +
                                     std::to_string(dictionary->bytesList.rows) +
                                     " markers, the board needs " + std::to_string(squares / 2));
  }
  return cv::aruco::CharucoBoard::create(board.points_x + 1, board.points_y + 1,
                                         static_cast<float>(board.spacing_m),
                                         static_cast<float>(board.marker_m), dictionary);
}

// Enough for a board's pose, and not all on one line.
bool IsSpread(const std::vector<int>& ids, int columns) {
  constexpr size_t kFewest = 8;
  std::set<int> seen_columns, seen_rows;
  for (const int id : ids) {
    seen_columns.insert(id % columns);
    seen_rows.insert(id / columns);
  }
  return ids.size() >= kFewest && seen_columns.size() >= 2 && seen_rows.size() >= 2;
}

// OpenCV 4.6 leaves the corners half a pixel aside. Within a window that ends before the markers'
// corners they come to a hundredth.
void RefineCharuco(const cv::Mat& grey, const Board& board, std::vector<cv::Point2f>* corners) {
  double closest = 1e9;
  for (size_t i = 0; i < corners->size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      closest = std::min(closest, cv::norm((*corners)[i] - (*corners)[j]));
    }
  }
  const double to_marker = closest * (1 - board.marker_m / board.spacing_m) / 2;
  const int half_window = std::max(2, static_cast<int>(0.8 * to_marker));
  cv::cornerSubPix(grey, *corners, {half_window, half_window}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-4});
}

std::optional<BoardPoints> FindCharuco(const cv::Mat& grey, const Board& board) {
  const auto charuco = CharucoOf(board);
  std::vector<std::vector<cv::Point2f>> markers, rejected;
  std::vector<int> markers_ids, ids;
  // The markers' corners are not refined: beside those of the squares they would be drawn to them.
  cv::aruco::detectMarkers(grey, charuco->dictionary, markers, markers_ids,
                           cv::aruco::DetectorParameters::create(), rejected);
  if (markers_ids.empty()) return std::nullopt;
  cv::aruco::refineDetectedMarkers(grey, charuco, markers, markers_ids, rejected);
  std::vector<cv::Point2f> corners;
  cv::aruco::interpolateCornersCharuco(markers, markers_ids, grey, charuco, corners, ids);
  if (!IsSpread(ids, board.points_x)) return std::nullopt;
  RefineCharuco(grey, board, &corners);
  BoardPoints points(static_cast<size_t>(board.points_x) * board.points_y);
  for (size_t i = 0; i < ids.size(); ++i) points[ids[i]] = {corners[i].x, corners[i].y};
  return points;
}

}  // namespace

std::optional<BoardPoints> FindBoard(const Raster& linear, const Board& board) {
  const cv::Mat grey = GreyCodes(linear);
  switch (board.pattern) {
    case BoardPattern::kChessboard:
      return FindChessboard(grey, board);
    case BoardPattern::kCharuco:
      return FindCharuco(grey, board);
    case BoardPattern::kCircles:
      return FindSymmetricCircles(grey, board);
    case BoardPattern::kAsymmetricCircles:
      return FindAsymmetricCircles(grey, board);
  }
  return std::nullopt;
}

}  // namespace insitu
