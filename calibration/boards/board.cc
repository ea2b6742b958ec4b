// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board.h"

#include <cmath>
#include <map>
#include <set>
#include <sstream>

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
  if (!fs::exists(path)) {
    throw InputError(path,
                     "no such file, expected it beside the board photos with the lines \"type "
                     "chessboard\", \"interior_corners_x 9\", \"interior_corners_y 9\" and "
                     "\"square_m 0.03\", as the board has them");
  }
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

}  // namespace insitu
