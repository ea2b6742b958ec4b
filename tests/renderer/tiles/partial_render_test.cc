// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/partial_render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <random>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;

const PartialHeader kHeader{70, 40, "photo", "0123abcd"};  // 3 x 2 tiles

FinishedTile TileOf(int index) {
  FinishedTile tile;
  tile.index = index;
  tile.counts = {5, index, 2, 1, 3, 1000000000000};
  std::mt19937 random(index);
  const int pixels = TileAt(kHeader.width, kHeader.height, index).pixels();
  for (int i = 0; i < pixels; ++i) {
    tile.is_computed.push_back(random() % 3 == 0);
    if (!tile.is_computed.back()) continue;
    for (int c = 0; c < 3; ++c) tile.rgb.push_back(static_cast<float>(random()) * 1e-10f);
    tile.unseen.push_back(static_cast<uint8_t>(random()));
  }
  return tile;
}

bool IsSame(const FinishedTile& a, const FinishedTile& b) {
  return a.index == b.index && a.is_computed == b.is_computed && a.rgb == b.rgb &&
         a.unseen == b.unseen && a.layers == b.layers && a.counts.building == b.counts.building &&
         a.counts.changed == b.counts.changed && a.counts.unseen == b.counts.unseen &&
         a.counts.rays == b.counts.rays;
}

class PartialRenderTest : public testing::Test {
 protected:
  void KeepTiles(const std::vector<int>& indices) {
    PartialRender partial(path_, kHeader);
    for (const int index : indices) partial.Keep(TileOf(index));
  }
  size_t EarlierTiles(const PartialHeader& header = kHeader) {
    return PartialRender(path_, header).TakeEarlier().size();
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path() / "render/photo.partial";
};

TEST(Tiles, OfAPictureThatNoTileDivides) {
  EXPECT_EQ(TileCount(70, 40), 6);
  const Tile last = TileAt(70, 40, 5);
  EXPECT_EQ(last.left, 64);
  EXPECT_EQ(last.right, 70);
  EXPECT_EQ(last.top, 32);
  EXPECT_EQ(last.bottom, 40);
}

TEST_F(PartialRenderTest, GivesBackToTheBitWhatWasKept) {
  KeepTiles({4, 0, 5, 0});  // twice the same is one
  const std::vector<FinishedTile> tiles = PartialRender(path_, kHeader).TakeEarlier();
  ASSERT_EQ(tiles.size(), 3u);
  EXPECT_TRUE(IsSame(tiles[0], TileOf(4)));
  EXPECT_TRUE(IsSame(tiles[2], TileOf(5)));
}

// A run with other layers renders a tile anew: what it has kept last is what the next one wants.
TEST_F(PartialRenderTest, TheLastOfATileCountsWithItsLayers) {
  FinishedTile with_layers = TileOf(1);
  with_layers.layers = std::string("depth \n\0\1", 9);
  {
    PartialRender partial(path_, kHeader);
    for (const FinishedTile& tile : {TileOf(1), TileOf(2), with_layers}) partial.Keep(tile);
  }
  PartialRender partial(path_, kHeader);
  const std::vector<FinishedTile> tiles = partial.TakeEarlier();
  ASSERT_EQ(tiles.size(), 2u);
  EXPECT_TRUE(IsSame(tiles[0], with_layers));
  EXPECT_TRUE(IsSame(tiles[1], TileOf(2)));
  for (const FinishedTile& tile : PartialRenderReader(path_).Read().tiles) {
    EXPECT_EQ(tile.layers, "");  // who looks on does not need them
  }
}

// What kill -9, a full disk and power loss may leave: the file ends, or holds anything, from some
// byte on.
TEST_F(PartialRenderTest, TakesTheWholeTilesOfAFileCutAnywhere) {
  KeepTiles({0, 1, 2});
  const std::string whole = ReadWhole(path_);
  const size_t header = HeaderText(kHeader).size();
  const size_t first = header + TileRecord(TileOf(0)).size();
  const size_t second = first + TileRecord(TileOf(1)).size();
  for (size_t length = 0; length < whole.size(); length += length < header + 40 ? 1 : 997) {
    for (const bool is_filled : {false, true}) {
      std::string cut = whole.substr(0, length);
      if (is_filled) cut.resize(whole.size(), '\0');
      WriteWhole(path_, cut);
      const size_t expected = length < first ? 0 : length < second ? 1 : 2;
      ASSERT_EQ(EarlierTiles(), expected) << length << is_filled;
      KeepTiles({3});
      ASSERT_EQ(EarlierTiles(), expected + 1) << length;
    }
  }
}

TEST_F(PartialRenderTest, NoBitIsTurnedUnseen) {
  KeepTiles({0, 1});
  const std::string whole = ReadWhole(path_);
  for (size_t at = HeaderText(kHeader).size(); at < whole.size(); at += 211) {
    std::string wrong = whole;
    wrong[at] = static_cast<char>(wrong[at] ^ 16);
    WriteWhole(path_, wrong);
    EXPECT_LT(EarlierTiles(), 2u) << at;
  }
}

TEST_F(PartialRenderTest, BeginsAnewForOtherInputs) {
  for (const PartialHeader& other :
       {PartialHeader{70, 40, "photo", "0123abce"}, PartialHeader{70, 40, "pinhole", "0123abcd"},
        PartialHeader{40, 70, "photo", "0123abcd"}}) {
    KeepTiles({0, 1});
    EXPECT_EQ(EarlierTiles(other), 0u);
    EXPECT_EQ(EarlierTiles(), 0u);
  }
}

TEST_F(PartialRenderTest, IsOneProgramsAtATime) {
  const PartialRender partial(path_, kHeader);
  try {
    const PartialRender second(path_, kHeader);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("another program is rendering this picture"));
  }
}

TEST_F(PartialRenderTest, AFullDiskIsToldAndLeavesWholeTiles) {
  PartialRender partial(path_, kHeader);
  partial.Keep(TileOf(0));
  signal(SIGXFSZ, SIG_IGN);
  rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{std::filesystem::file_size(path_) + 100, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_FALSE(partial.has_failed());
  partial.Keep(TileOf(1));
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(partial.has_failed());
  EXPECT_THAT(partial.failure(), HasSubstr("photo.partial: cannot be written: File too large"));
  partial.Keep(TileOf(2));  // after a hole nothing would be found
  PartialRenderReader reader(path_);
  EXPECT_EQ(reader.Read().tiles.size(), 1u);
}

TEST_F(PartialRenderTest, IsFollowedWhileItIsWritten) {
  PartialRenderReader reader(path_);
  EXPECT_FALSE(reader.Read().header);
  {
    PartialRender partial(path_, kHeader);
    partial.Keep(TileOf(2));
    PartialRenderReader::News news = reader.Read();
    EXPECT_EQ(news.header, kHeader);
    EXPECT_TRUE(news.is_running);
    ASSERT_EQ(news.tiles.size(), 1u);
    EXPECT_TRUE(IsSame(news.tiles[0], TileOf(2)));
    EXPECT_TRUE(reader.Read().tiles.empty());
    partial.Keep(TileOf(3));
    news = reader.Read();
    EXPECT_FALSE(news.is_anew);
    ASSERT_EQ(news.tiles.size(), 1u);
  }
  EXPECT_FALSE(reader.Read().is_running);
  PartialRender other(path_, {70, 40, "photo", "ffff"});  // begun anew, in the same file
  for (const int index : {0, 1, 2, 3, 4}) other.Keep(TileOf(index));
  PartialRenderReader::News news = reader.Read();
  EXPECT_TRUE(news.is_anew);
  EXPECT_EQ(news.tiles.size(), 5u);
  other.Remove();
  news = reader.Read();
  EXPECT_TRUE(news.is_anew);
  EXPECT_FALSE(news.header);
}

}  // namespace
}  // namespace insitu
