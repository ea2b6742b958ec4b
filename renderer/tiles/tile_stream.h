// SPDX-License-Identifier: GPL-3.0-or-later
// A picture that is being rendered as text in a pipe, a statement a line [Durisch92, §6.4]:
//
//   insitu-stream 1
//   image NAME WIDTH HEIGHT tile 32
//   photo W H                      the photograph reduced, rows of it follow
//   same COLUMN ROW                a tile that is the photograph's
//   tile COLUMN ROW W H            rows of it follow, or after "base64" a line
//   progress DONE TOTAL            tiles; at least one a second
//   end done | end stopped
//
// Rows are decimal sRGB codes, red green blue, as in a plain PPM. After `end`, a further `image`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibration/photo/raster.h"
#include "renderer/tiles/finished_tile.h"

namespace insitu {

// sRGB codes, red green blue, row by row.
struct CodeImage {
  int width = 0, height = 0;  // [px]
  std::vector<uint8_t> codes;
};

enum class StreamCoding { kDecimal, kBase64 };

std::string StreamBegin();
std::string ImageStatement(const std::string& name, int width, int height);
std::string PhotoStatement(const CodeImage& reduced);
std::string ProgressStatement(int done, int total);
std::string EndStatement(bool is_whole);

// `codes`: of the whole tile; empty: the photograph's.
std::string TileStatement(int width, int height, int index, const std::vector<uint8_t>& codes,
                          StreamCoding coding);

// The codes of a tile: computed pixels, elsewhere the photograph's; empty if nothing is computed.
std::vector<uint8_t> TileCodes(const FinishedTile& tile, const Raster& photo);

// Means over squares, at most so many pixels wide and high.
CodeImage Reduced(const Raster& photo, int most);

// The newest picture of a stream, line by line. What comes in is of anybody.
class StreamedPicture {
 public:
  // Without its end. Throws InputError that names the line: no such statement, or not of a picture
  // that was begun.
  void TakeLine(const std::string& line);

  bool has_picture() const { return picture_.width > 0; }
  const std::string& name() const { return name_; }  // printable
  // Tiles that are not done hold the photograph, reduced; is_done tells them apart.
  const CodeImage& picture() const { return picture_; }
  bool IsDone(int tile) const { return is_done_[tile] != 0; }
  int done() const { return done_; }
  int total() const { return static_cast<int>(is_done_.size()); }
  int pictures() const { return pictures_; }  // that have begun
  enum class State { kRunning, kDone, kStopped };
  State state() const { return state_; }
  // Of tiles and the photograph, in the order they came, since the last call.
  std::vector<int> TakeNews();

 private:
  [[noreturn]] void Refuse(const std::string& what) const;
  void Begin(const std::vector<std::string>& words);
  void Await(const std::vector<std::string>& words);
  void TakeRow(const std::string& line);
  void Finish();
  void ShowPhoto();

  int line_ = 0;
  bool has_begun_ = false;
  std::string name_;
  CodeImage picture_, photo_;
  std::vector<char> is_done_;
  std::vector<int> news_;
  int done_ = 0, pictures_ = 0;
  State state_ = State::kRunning;
  // What rows are awaited of: a tile, -1 the photograph; nothing without rows left.
  int awaited_ = -1, rows_left_ = 0;
  bool is_base64_ = false;
  CodeImage block_;
};

}  // namespace insitu
