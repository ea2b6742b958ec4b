// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/named_system.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"

namespace insitu {
namespace {

std::string CodeOf(const std::string& words) { return SystemByWords("f.txt", words).system.Code(); }

std::string RefusalOf(const std::string& words) {
  try {
    return "taken for " + CodeOf(words);
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(NamedSystem, UtmZonesByHemisphereOrBand) {
  EXPECT_EQ(CodeOf("30U"), "EPSG:32630");
  EXPECT_EQ(CodeOf("WGS84 UTM 30U"), "EPSG:32630");
  EXPECT_EQ(CodeOf("UTM33N"), "EPSG:32633");
  EXPECT_EQ(CodeOf("WGS84 UTM33N"), "EPSG:32633");
  EXPECT_EQ(CodeOf("WGS 84 / UTM zone 33N"), "EPSG:32633");
  EXPECT_EQ(CodeOf("utm zone 21H"), "EPSG:32721");
  EXPECT_EQ(CodeOf("ETRS89 UTM32"), "EPSG:25832");
  EXPECT_EQ(CodeOf("WGS84 UTM 17S"), "EPSG:32717");
  EXPECT_NE(SystemByWords("f.txt", "WGS84 UTM 17S").remark.find("write 17N"), std::string::npos);
  EXPECT_NE(RefusalOf("UTM 33").find("33N or 33S"), std::string::npos);
}

TEST(NamedSystem, CodesWithoutTheirColon) {
  EXPECT_EQ(CodeOf("25832"), "EPSG:25832");
  EXPECT_EQ(CodeOf("EPSG 2056"), "EPSG:2056");
  EXPECT_EQ(CodeOf("epsg31468"), "EPSG:31468");
  EXPECT_NE(RefusalOf("99999").find("not known"), std::string::npos);
}

TEST(NamedSystem, WordsOfNationalSystems) {
  EXPECT_EQ(CodeOf("LV95"), "EPSG:2056");
  EXPECT_EQ(CodeOf("CH1903+ / LV95"), "EPSG:2056");
  EXPECT_EQ(CodeOf("LV03"), "EPSG:21781");
  EXPECT_EQ(CodeOf("DHDN / 3-degree zone 4"), "EPSG:31468");
  EXPECT_EQ(CodeOf("MGI Austria GK Central"), "EPSG:31255");
  EXPECT_EQ(CodeOf("Lambert 93"), "EPSG:2154");
  EXPECT_EQ(CodeOf("WGS84 longlat"), "EPSG:4326");
  EXPECT_NE(SystemByWords("f.txt", "LV95").remark.find("CH1903+ / LV95"), std::string::npos);
}

TEST(NamedSystem, TheNearestAreNamed) {
  EXPECT_NE(RefusalOf("Gauss-Krueger zone 4").find("did you mean"), std::string::npos);
  EXPECT_NE(RefusalOf("MGI / Austria").find("EPSG:31"), std::string::npos)
      << RefusalOf("MGI / Austria");
  EXPECT_NE(RefusalOf("Mars").find("not known"), std::string::npos);
  EXPECT_NE(RefusalOf("EPSG:39791798743.39 -68423.09").find("in one line"), std::string::npos);
}

TEST(NamedSystem, AreasOfUse) {
  const auto area = AreaOf(SystemByWords("f.txt", "LV95").system);
  ASSERT_TRUE(area);
  EXPECT_EQ(area->Excess({8, 47}), 0);
  EXPECT_NEAR(area->Excess({8, 50}), 50 - 47.81, 1e-9);
  EXPECT_FALSE(AreaOf(SystemByWords("f.txt", "+proj=tmerc +lat_0=0 +lon_0=9 +k=1").system));
}

}  // namespace
}  // namespace insitu
