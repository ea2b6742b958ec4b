// SPDX-License-Identifier: GPL-3.0-or-later
// Large photographs in linear light, some rows at a time: whole ones take 12 bytes a pixel.
#pragma once

#include <filesystem>
#include <memory>

#include "calibration/photo/photograph.h"

namespace insitu {

// Rows `first` to before `end` of what ReadPhotograph would hold.
Raster LinearRows(const CodedPhotograph& photo, int first, int end);

// An EXR of three channels, linear Rec. 709 of 32-bit float, written from the top; in tiles, so
// that a part of it can be read alone.
inline constexpr int kExrTile = 64;  // [px]
class ExrRows {
 public:
  ExrRows(const std::filesystem::path& path, int width, int height);
  ~ExrRows();
  ExrRows(const ExrRows&) = delete;
  ExrRows& operator=(const ExrRows&) = delete;

  void Append(const Raster& rows);  // a multiple of kExrTile, but for the last
  void Close();                     // after the last row

 private:
  struct Output;
  std::unique_ptr<Output> output_;
};

}  // namespace insitu
