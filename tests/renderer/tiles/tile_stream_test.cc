// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/tile_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 70, kHeight = 40;  // 3 x 2 tiles

// Half of it white.
Raster Photo() {
  Raster photo(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth / 2; ++x) photo.SetRgb(x, y, {1, 1, 1});
  }
  return photo;
}

// A tile of which every other pixel is red.
FinishedTile RedTile(int index) {
  FinishedTile tile;
  tile.index = index;
  for (int i = 0; i < TileAt(kWidth, kHeight, index).pixels(); ++i) {
    tile.is_computed.push_back(i % 2);
    if (i % 2) tile.rgb.insert(tile.rgb.end(), {1, 0, 0});
  }
  return tile;
}

void TakeAll(const std::string& text, StreamedPicture* streamed) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) streamed->TakeLine(line);
}

std::string Complaint(const std::string& text) {
  StreamedPicture streamed;
  try {
    TakeAll(text, &streamed);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TileStream, ComesOutAsItWentIn) {
  const Raster photo = Photo();
  for (const StreamCoding coding : {StreamCoding::kDecimal, StreamCoding::kBase64}) {
    std::string text = StreamBegin() + ImageStatement("a photo", kWidth, kHeight) +
                       PhotoStatement(Reduced(photo, 35));
    text += TileStatement(kWidth, kHeight, 5, TileCodes(RedTile(5), photo), coding);
    FinishedTile same;
    same.index = 0;
    same.is_computed.assign(1024, 0);
    text += TileStatement(kWidth, kHeight, 0, TileCodes(same, photo), coding);
    text += ProgressStatement(2, 6) + EndStatement(false);
    StreamedPicture streamed;
    TakeAll(text, &streamed);
    EXPECT_EQ(streamed.name(), "a photo");
    EXPECT_EQ(streamed.done(), 2);
    EXPECT_EQ(streamed.total(), 6);
    EXPECT_TRUE(streamed.IsDone(5));
    EXPECT_FALSE(streamed.IsDone(4));
    EXPECT_EQ(streamed.state(), StreamedPicture::State::kStopped);
    const auto at = [&](int x, int y) {
      const uint8_t* rgb = &streamed.picture().codes[3 * (size_t{kWidth} * y + x)];
      return std::vector<int>(rgb, rgb + 3);
    };
    EXPECT_EQ(at(65, 33), (std::vector{255, 0, 0}));  // of the last tile, which is 6 px wide
    EXPECT_EQ(at(64, 33), (std::vector{0, 0, 0}));
    EXPECT_EQ(at(3, 3), (std::vector{255, 255, 255}));  // the photograph's
    EXPECT_EQ(at(60, 3), (std::vector{0, 0, 0}));
  }
}

TEST(TileStream, WhatTheNotesShowIsRead) {
  StreamedPicture streamed;
  TakeAll("insitu-stream 1\nimage IMG_2102 1800 1200 tile 32\nsame 0 3\nprogress 1 2166\n",
          &streamed);
  EXPECT_EQ(streamed.total(), 57 * 38);
  EXPECT_TRUE(streamed.IsDone(3 * 57));
}

TEST(TileStream, RefusesWhatIsNoneByItsLine) {
  const std::string begin = "insitu-stream 1\nimage a 70 40 tile 32\n";
  EXPECT_THAT(Complaint("P6\n"), HasSubstr("stream:1: does not begin with insitu-stream 1"));
  EXPECT_THAT(Complaint("insitu-stream 1\ntile 0 0 32 32\n"), HasSubstr("stream:2: has no image"));
  EXPECT_THAT(Complaint("insitu-stream 1\nimage a 1000000 1000000 tile 32\n"),
              HasSubstr("no size"));
  EXPECT_THAT(Complaint("insitu-stream 1\nimage a -3 40 tile 32\n"), HasSubstr("no size"));
  EXPECT_THAT(Complaint("insitu-stream 1\nimage a 70 40 tile 16\n"), HasSubstr("another size"));
  EXPECT_THAT(Complaint(begin + "same 3 0\n"), HasSubstr("stream:3: is a tile beyond the image"));
  EXPECT_THAT(Complaint(begin + "same 0 -1\n"), HasSubstr("beyond the image"));
  EXPECT_THAT(Complaint(begin + "tile 0 0 31 32\n"), HasSubstr("of another size"));
  EXPECT_THAT(Complaint(begin + "tile 2 1 6 8\n1 2 3\n"),
              HasSubstr("stream:4: is a row of another"));
  EXPECT_THAT(Complaint(begin + "tile 2 1 6 8\n1 2 256\n"), HasSubstr("no code of 0 to 255"));
  EXPECT_THAT(Complaint(begin + "tile 2 1 6 8 base64\nAAAA\n"), HasSubstr("another length"));
  EXPECT_THAT(Complaint(begin + "tile 2 1 6 8 base64\n!!!!\n"), HasSubstr("another length"));
  EXPECT_THAT(Complaint(begin + "photo 0 9\n"), HasSubstr("is no photo"));
  EXPECT_THAT(Complaint(begin + "photo 9999 9999\n"), HasSubstr("is no photo"));
  EXPECT_THAT(Complaint(begin + "end done\n"), HasSubstr("ends as done with tiles missing"));
  EXPECT_THAT(Complaint(begin + "\x1b]0;title\x07\n"), HasSubstr("is no statement: ?]0;title?"));
}

// Of another machine: nothing of a name reaches the terminal but letters.
TEST(TileStream, NamesArePrintable) {
  StreamedPicture streamed;
  TakeAll("insitu-stream 1\nimage a\x1b[2J b 70 40 tile 32\n", &streamed);
  EXPECT_EQ(streamed.name(), "a?[2J b");
}

}  // namespace
}  // namespace insitu
