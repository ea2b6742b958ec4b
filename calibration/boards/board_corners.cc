// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board_corners.h"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "calibration/boards/find_board.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/external_program.h"
#include "calibration/program/program.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr char kCorners[] = "corners.vnl";

// The lines of a photograph in the table that mrcal reads.
std::string LinesOf(const std::string& photo, const std::optional<BoardPoints>& points) {
  if (!points) return photo + " - -\n";
  std::string lines;
  for (const std::optional<Eigen::Vector2d>& point : *points) {
    lines += photo + (point ? Formatted(" %.6f %.6f 0\n", point->x(), point->y()) : " - - -\n");
  }
  return lines;
}

std::vector<fs::path> PhotosIn(const fs::path& folder) {
  std::vector<fs::path> photos;
  for (const auto& entry : fs::directory_iterator(folder / "photos")) {
    photos.push_back(entry.path());
  }
  std::sort(photos.begin(), photos.end());
  return photos;
}

void FindByOpenCv(const Board& board, const fs::path& folder) {
  const std::vector<fs::path> photos = PhotosIn(folder);
  Progress progress("finding boards", static_cast<int>(photos.size()));
  std::string table = "# filename x y level\n";
  for (const fs::path& path : photos) {
    table += LinesOf("photos/" + path.filename().string(),
                     FindBoard(ReadPhotograph(path).linear, board));
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

// A photograph without a board has one line, which names no place.
bool IsFound(const std::string& photo, const std::string& lines) {
  return lines.find('\n') + 1 != lines.size() || lines.compare(photo.size(), 3, " - ") != 0;
}

// mrgingham's worker processes report in the order in which they finish. Where they found nothing
// OpenCV looks once more.
void CompleteAndSort(const Board& board, const fs::path& corners) {
  const CornerTable table = ReadCornerTable(corners);
  std::string sorted = table.head;
  for (const auto& [photo, lines] : table.lines_of_photo) {
    if (IsFound(photo, lines)) {
      sorted += lines;
    } else {
      const fs::path path = corners.parent_path() / photo;
      sorted += LinesOf(photo, FindBoard(ReadPhotograph(path).linear, board));
    }
  }
  WriteWhole(corners, sorted);
}

}  // namespace

fs::path FindBoardCorners(const Board& board, const fs::path& folder) {
  if (board.pattern != BoardPattern::kChessboard || board.points_x != board.points_y) {
    FindByOpenCv(board, folder);
    return folder / kCorners;
  }
  const std::vector<fs::path> photos = PhotosIn(folder);
  Progress progress("finding boards", static_cast<int>(photos.size()));
  size_t done = 0;
  RunExternal({.command = {"mrgingham", "--jobs", "2", "--gridn", std::to_string(board.points_x),
                           "photos/*"},
               .package = "mrgingham",
               .folder = folder,
               .output = folder / kCorners,
               .log = folder / "mrgingham.log",
               .while_running = [&] {
                 const size_t found = ReadCornerTable(folder / kCorners).lines_of_photo.size();
                 for (; done < found; ++done) progress.Step();
                 progress.Show();
               }});
  CompleteAndSort(board, folder / kCorners);
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
