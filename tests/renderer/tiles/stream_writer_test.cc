// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/stream_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <optional>
#include <sstream>
#include <thread>

namespace insitu {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSide = 320;  // [px], 100 tiles

FinishedTile WhiteTile(int index) {
  FinishedTile tile;
  tile.index = index;
  tile.is_computed.assign(1024, 1);
  tile.rgb.assign(3072, 1);
  return tile;
}

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class StreamWriterTest : public testing::Test {
 protected:
  StreamWriterTest() { EXPECT_EQ(pipe(ends_.data()), 0); }
  ~StreamWriterTest() override {
    if (ends_[0] >= 0) close(ends_[0]);
    if (ends_[1] >= 0) close(ends_[1]);
  }
  std::string ReadAll() {
    std::string text;
    std::array<char, 65536> bytes;
    for (ssize_t count = 1; count > 0;) {
      count = read(ends_[0], bytes.data(), bytes.size());
      if (count > 0) text.append(bytes.data(), static_cast<size_t>(count));
    }
    return text;
  }
  void CloseWriteEnd() {
    close(ends_[1]);
    ends_[1] = -1;
  }

  std::array<int, 2> ends_ = {-1, -1};
  Raster photo_{kSide, kSide};
};

TEST_F(StreamWriterTest, AReaderGetsEveryTileOfEveryPicture) {
  std::string text;
  std::thread reader([&] { text = ReadAll(); });
  {
    RenderStream writer(ends_[1], TextFormat(StreamCoding::kBase64));
    for (const char* name : {"first", "second"}) {
      writer.Begin(name, photo_);
      for (int i = 0; i < 100; ++i) writer.Take(WhiteTile(i));
      writer.End(true);
    }
  }
  CloseWriteEnd();
  reader.join();
  StreamedPicture streamed;
  std::istringstream lines(text);
  int ended = 0;
  for (std::string line; std::getline(lines, line);) {
    streamed.TakeLine(line);
    ended += line == "end done";
  }
  EXPECT_EQ(ended, 2);
  EXPECT_EQ(streamed.name(), "second");
  EXPECT_EQ(streamed.done(), 100);
  EXPECT_EQ(streamed.picture().codes, std::vector<uint8_t>(size_t{3} * kSide * kSide, 255));
}

// 1.2 MB do not fit into the pipe.
TEST_F(StreamWriterTest, AReaderThatDoesNotReadCostsTheRenderNothing) {
  std::optional<RenderStream> writer;
  writer.emplace(ends_[1], TextFormat(StreamCoding::kDecimal));
  writer->Begin("photo", photo_);
  const auto begin = Clock::now();
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 100; ++i) writer->Take(WhiteTile(i));
  }
  writer->End(true);
  EXPECT_LT(SecondsSince(begin), 1);
  writer.reset();  // at the end it is waited for a while, then given up
  EXPECT_GT(SecondsSince(begin), 1);
  EXPECT_LT(SecondsSince(begin), 20);
}

TEST_F(StreamWriterTest, AReaderThatHasGoneEndsTheStreamAlone) {
  close(ends_[0]);
  ends_[0] = -1;
  RenderStream writer(ends_[1], TextFormat(StreamCoding::kDecimal));
  writer.Begin("photo", photo_);
  for (int i = 0; i < 100; ++i) writer.Take(WhiteTile(i));
  for (int i = 0; i < 500 && !writer.is_closed(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(writer.is_closed());
  writer.Take(WhiteTile(1));
  writer.End(true);
}

TEST_F(StreamWriterTest, TellsThatItLivesWhenNothingComes) {
  std::string text;
  std::thread reader([&] { text = ReadAll(); });
  {
    RenderStream writer(ends_[1], TextFormat(StreamCoding::kDecimal));
    writer.Begin("photo", photo_);
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    writer.End(false);
  }
  CloseWriteEnd();
  reader.join();
  int signs = 0;
  for (size_t at = 0; (at = text.find("progress 0 100\n", at)) != std::string::npos; ++at) ++signs;
  EXPECT_GE(signs, 3);
  EXPECT_LE(signs, 8);
}

}  // namespace
}  // namespace insitu
