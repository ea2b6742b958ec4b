// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/cryptomatte.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace insitu {
namespace {

// Appleby's own verification values.
TEST(MurmurHash3, AgreesWithPublishedValues) {
  EXPECT_EQ(MurmurHash3(""), 0U);
  EXPECT_EQ(MurmurHash3("test"), 0xba6bd213U);
  EXPECT_EQ(MurmurHash3("Hello, world!"), 0xc0363e43U);
  EXPECT_EQ(MurmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
}

// Those of the specification's example code.
TEST(CryptomatteId, AgreesWithTheSpecification) {
  EXPECT_FLOAT_EQ(CryptomatteId("hello"), 6.0705627102400005616e-17F);
  EXPECT_FLOAT_EQ(CryptomatteId("cube"), -4.08461912519e+15F);
  EXPECT_FLOAT_EQ(CryptomatteId("sphere"), 2.79018604383e+15F);
}

TEST(CryptomatteId, IsAlwaysANumber) {
  for (int i = 0; i < 20000; ++i) EXPECT_TRUE(std::isnormal(CryptomatteId(std::to_string(i)))) << i;
}

TEST(CryptomatteRanks, ComeLargestFirstAndFillUpWithZeros) {
  const std::vector<float> ids = {1, 2, 3, 4, 5};
  EXPECT_THAT(CryptomatteRanks({{0, 0.25}, {2, 0.75}}, ids),
              testing::ElementsAre(3, 0.75F, 1, 0.25F, 0, 0, 0, 0));
  EXPECT_THAT(CryptomatteRanks({{0, 0.1}, {1, 0.3}, {2, 0.2}, {3, 0.25}, {4, 0.15}}, ids),
              testing::ElementsAre(2, 0.3F, 4, 0.25F, 3, 0.2F, 5, 0.15F));
  EXPECT_THAT(CryptomatteRanks({}, ids), testing::Each(0));
}

TEST(CryptomatteManifest, NamesEachIdInHexadecimal) {
  EXPECT_EQ(CryptomatteManifest({"hello"}), R"({"hello":"248bfa47"})");
  EXPECT_EQ(CryptomatteKey("hello"), "248bfa4");
}

}  // namespace
}  // namespace insitu
