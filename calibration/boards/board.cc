// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

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
    if (!lines.emplace(key, BoardLine{number, value}).second) {
      throw InputError(path, number, key + " stands twice, expected it once");
    }
  }
  return lines;
}

// The keys of each type, besides type and note.
const std::map<std::string, std::vector<std::string>>& KeysOfTypes() {
  static const std::map<std::string, std::vector<std::string>> keys = {
      {"chessboard", {"interior_corners_x", "interior_corners_y", "square_m"}},
      {"charuco", {"squares_x", "squares_y", "square_m", "marker_m", "dictionary"}},
      {"circles", {"circles_x", "circles_y", "spacing_m"}},
      {"asymmetric_circles", {"circles_x", "circles_y", "spacing_m"}}};
  return keys;
}

InputError UnknownKey(const fs::path& path, int line, const std::string& key,
                      const std::vector<std::string>& known_keys) {
  std::string expected = "type";
  for (const std::string& known : known_keys) expected += ", " + known;
  return {path, line, "\"" + key + "\" is unknown, expected " + expected + " or note"};
}

void CheckKeys(const fs::path& path, const std::map<std::string, BoardLine>& lines) {
  if (!lines.contains("type")) throw InputError(path, "type is missing");
  const BoardLine& type = lines.at("type");
  const auto keys = KeysOfTypes().find(type.value);
  if (keys == KeysOfTypes().end()) {
    throw InputError(path, type.line,
                     "\"" + type.value +
                         "\" as type, expected chessboard, charuco, circles or asymmetric_circles");
  }
  for (const auto& [key, line] : lines) {
    if (key == "type" || key == "note" || std::ranges::count(keys->second, key) > 0) continue;
    throw UnknownKey(path, line.line, key, keys->second);
  }
  for (const std::string& key : keys->second) {
    if (!lines.contains(key)) throw InputError(path, key + " is missing");
  }
}

// Numbers of board.txt, each refused by its line.
struct BoardNumbers {
  const fs::path& path;
  const std::map<std::string, BoardLine>& lines;

  template <typename Number>
  Number Of(const std::string& key) const {
    return PositiveNumber<Number>(path, lines.at(key).line, key, lines.at(key).value);
  }
};

void ReadCharuco(const BoardNumbers& numbers, Board* board) {
  board->points_x = numbers.Of<int>("squares_x") - 1;
  board->points_y = numbers.Of<int>("squares_y") - 1;
  board->spacing_m = numbers.Of<double>("square_m");
  board->marker_m = numbers.Of<double>("marker_m");
  board->dictionary = numbers.lines.at("dictionary").value;
  if (board->marker_m >= board->spacing_m) {
    throw InputError(numbers.path, numbers.lines.at("marker_m").line,
                     "marker_m is not smaller than square_m: a marker stands within its square");
  }
}

}  // namespace

Board ReadBoard(const fs::path& path) {
  if (!fs::exists(path)) {
    throw InputError(path,
                     "no such file, expected it beside the board photos with the lines \"type "
                     "chessboard\", \"interior_corners_x 9\", \"interior_corners_y 9\" and "
                     "\"square_m 0.03\", as the board has them");
  }
  const std::map<std::string, BoardLine> lines = ReadBoardLines(path);
  CheckKeys(path, lines);
  const BoardNumbers numbers{path, lines};
  const std::string& type = lines.at("type").value;
  Board board;
  board.path = path;
  if (type == "charuco") {
    board.pattern = BoardPattern::kCharuco;
    ReadCharuco(numbers, &board);
  } else if (type == "chessboard") {
    board.points_x = numbers.Of<int>("interior_corners_x");
    board.points_y = numbers.Of<int>("interior_corners_y");
    board.spacing_m = numbers.Of<double>("square_m");
  } else {
    const bool is_asymmetric = type == "asymmetric_circles";
    board.pattern = is_asymmetric ? BoardPattern::kAsymmetricCircles : BoardPattern::kCircles;
    board.points_x = numbers.Of<int>("circles_x") * (is_asymmetric ? 2 : 1);
    board.points_y = numbers.Of<int>("circles_y");
    board.spacing_m = numbers.Of<double>("spacing_m") / (is_asymmetric ? 2 : 1);
  }
  if (std::min(board.points_x, board.points_y) < 2) {
    throw InputError(path, "the board has fewer than 2 x 2 points to be found");
  }
  return board;
}

}  // namespace insitu
