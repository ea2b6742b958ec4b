// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/stream_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

constexpr auto kShowEvery = std::chrono::seconds(1);
constexpr int kSnapshotPeriod = 12, kSnapshotWidth = 4;  // of hatches [px]
constexpr std::array<uint8_t, 3> kUnfinishedColor = {230, 159, 0};

bool IsUnfinished(const StreamedPicture& streamed, int x, int y) {
  const int columns = (streamed.picture().width + kRenderTile - 1) / kRenderTile;
  return !streamed.IsDone(y / kRenderTile * columns + x / kRenderTile);
}

std::array<uint8_t, 3> PixelOf(const StreamedPicture& streamed, int x, int y) {
  const CodeImage& picture = streamed.picture();
  const uint8_t* rgb = &picture.codes[3 * (static_cast<size_t>(y) * picture.width + x)];
  return {rgb[0], rgb[1], rgb[2]};
}

// The mean over the pixels that a place of the terminal stands for; every other place of what is
// not finished has its colour.
std::array<uint8_t, 3> PlaceOf(const StreamedPicture& streamed, int column, int row, double step) {
  const CodeImage& picture = streamed.picture();
  const int left = std::min(static_cast<int>(column * step), picture.width - 1);
  const int top = std::min(static_cast<int>(row * step), picture.height - 1);
  const int right = std::clamp(static_cast<int>((column + 1) * step), left + 1, picture.width);
  const int bottom = std::clamp(static_cast<int>((row + 1) * step), top + 1, picture.height);
  std::array<int64_t, 3> sum = {};
  bool is_unfinished = false;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const std::array<uint8_t, 3> rgb = PixelOf(streamed, x, y);
      for (int c = 0; c < 3; ++c) sum[c] += rgb[c];
      is_unfinished = is_unfinished || IsUnfinished(streamed, x, y);
    }
  }
  if (is_unfinished && (column + row) % 2 == 0) return kUnfinishedColor;
  const int64_t count = int64_t{right - left} * (bottom - top);
  std::array<uint8_t, 3> mean = {};
  for (int c = 0; c < 3; ++c) mean[c] = static_cast<uint8_t>(sum[c] / count);
  return mean;
}

std::string ColorText(int ground, const std::array<uint8_t, 3>& rgb) {
  return "\x1b[" + std::to_string(ground) + ";2;" + std::to_string(rgb[0]) + ";" +
         std::to_string(rgb[1]) + ";" + std::to_string(rgb[2]) + "m";
}

}  // namespace

void WriteSnapshot(const std::filesystem::path& path, const StreamedPicture& streamed) {
  const CodeImage& picture = streamed.picture();
  std::string content =
      "P6\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n";
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const bool is_hatch = (x + y) % kSnapshotPeriod < kSnapshotWidth;
      const auto rgb =
          is_hatch && IsUnfinished(streamed, x, y) ? kUnfinishedColor : PixelOf(streamed, x, y);
      content.append(rgb.begin(), rgb.end());
    }
  }
  WriteWhole(path, content);
}

std::string TerminalText(const StreamedPicture& streamed, int columns) {
  const CodeImage& picture = streamed.picture();
  const int wide = std::max(1, std::min(columns, picture.width));
  const double step = static_cast<double>(picture.width) / wide;
  const int rows = std::max(1, static_cast<int>(std::lround(picture.height / step)));
  std::string text;
  for (int row = 0; row < rows; row += 2) {
    for (int column = 0; column < wide; ++column) {
      text += ColorText(38, PlaceOf(streamed, column, row, step));
      if (row + 1 < rows) text += ColorText(48, PlaceOf(streamed, column, row + 1, step));
      text += "\u2580";  // its upper half
    }
    text += "\x1b[0m\n";
  }
  return text + streamed.name() + ": " + std::to_string(streamed.done()) + " of " +
         std::to_string(streamed.total()) + " tiles\n";
}

void ViewStream(const StreamViewOptions& options,
                const std::function<void(const std::string& text)>& show) {
  StreamedPicture streamed;
  bool is_shown = true;
  auto last = std::chrono::steady_clock::now() - kShowEvery;
  const auto present = [&] {
    if (!streamed.has_picture()) return;
    if (options.is_text) show(TerminalText(streamed, options.columns));
    if (!options.snapshot.empty()) WriteSnapshot(options.snapshot, streamed);
    last = std::chrono::steady_clock::now();
    is_shown = true;
  };
  std::string line;
  while (std::getline(std::cin, line)) {
    if (std::cin.eof()) break;  // cut within a line
    streamed.TakeLine(line);
    is_shown = false;
    const bool has_ended =
        streamed.has_picture() && streamed.state() != StreamedPicture::State::kRunning;
    if (has_ended || std::chrono::steady_clock::now() - last >= kShowEvery) present();
  }
  if (!is_shown) present();
  if (!streamed.has_picture()) throw InputError("stream", "holds no picture");
  if (streamed.state() == StreamedPicture::State::kDone) return;
  throw InputError(
      "stream",
      std::string(streamed.state() == StreamedPicture::State::kStopped ? "was stopped" : "ended") +
          " after " + std::to_string(streamed.done()) + " of " + std::to_string(streamed.total()) +
          " tiles of " + streamed.name() + ": what is missing is hatched");
}

}  // namespace insitu
