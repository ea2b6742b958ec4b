// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/light_cache.h"

#include <gtest/gtest.h>

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

class LightCacheTest : public testing::Test {
 protected:
  LightCacheTest() {
    light_.solved.sky.setConstant(0.1);
    light_.solved.beyond.setLinSpaced(0, 1);
    light_.solved.brdf_of_polygon = {Spectrum::Constant(0.3)};
    SolvedPiece piece;
    piece.point = {{1, 2, 1.0 / 3}, Eigen::Vector3d::UnitY()};
    piece.polygon = 7;
    piece.is_seen = true;
    piece.change.setConstant(-0.2);
    light_.solved.pieces = {piece, {}};
    light_.on_site = {{{1, -2, 3, 4, 5, 6}, piece.change, piece.before, 0.7, false}};
    WriteLightCache(file_, "inputs", light_);
  }

  ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "work/light.cache";
  KeptLight light_;
};

TEST_F(LightCacheTest, ReadsWhatWasWritten) {
  const auto read = ReadLightCache(file_, "inputs");
  ASSERT_TRUE(read);
  EXPECT_TRUE((read->solved.beyond == light_.solved.beyond).all());
  ASSERT_EQ(read->solved.pieces.size(), 2u);
  EXPECT_EQ(read->solved.pieces[0].point.position, light_.solved.pieces[0].point.position);
  EXPECT_EQ(read->solved.pieces[0].polygon, 7);
  EXPECT_TRUE(read->solved.pieces[0].is_seen);
  EXPECT_TRUE((read->solved.pieces[0].change == -0.2).all());
  ASSERT_EQ(read->on_site.size(), 1u);
  EXPECT_EQ(read->on_site[0].cells, light_.on_site[0].cells);
  EXPECT_EQ(read->on_site[0].calm, 0.7);
  EXPECT_FALSE(read->on_site[0].is_open);
  EXPECT_TRUE(read->on_building.empty());
}

TEST_F(LightCacheTest, OfOtherInputsOrNotThereItIsNone) {
  EXPECT_FALSE(ReadLightCache(file_, "input"));
  EXPECT_FALSE(ReadLightCache(file_, "inputs2"));
  EXPECT_FALSE(ReadLightCache(folder_.path() / "none", "inputs"));
}

TEST_F(LightCacheTest, AnyBitThatChangedIsTold) {
  const std::string whole = ReadWhole(file_);
  for (size_t i = 0; i < whole.size(); i += 7) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 4);
    WriteWhole(file_, changed);
    EXPECT_FALSE(ReadLightCache(file_, "inputs")) << i;
  }
  for (const size_t size : {size_t{0}, size_t{10}, whole.size() / 2, whole.size() - 1}) {
    WriteWhole(file_, whole.substr(0, size));
    EXPECT_FALSE(ReadLightCache(file_, "inputs")) << size;
  }
}

}  // namespace
}  // namespace insitu
