// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/library_answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(LibraryAnswer, OffersWhatASurveysMaterialsMayUse) {
  ScratchFolder folder;
  const std::string head = R"({"source": "s", "licence": "l", "kind": )";
  folder.Write("library/a/matte.json", head + R"("material", "title": "matt one",
    "reflectance": [[400, 0.2], [700, 0.2]]})");
  folder.Write("library/b/wet.json", head + R"("material", "title": "wet one",
    "diffuse_rgb": [0.1, 0.2, 0.3], "specular": "fresnel", "ior": 1.33})");
  folder.Write("library/b/bare.json", head + R"("material", "title": "bare metal",
    "diffuse_rgb": [0, 0, 0], "specular": "conductor", "complex_index": [[400, 1, 5], [700, 1, 5]]})");
  folder.Write("library/lamp.json", head + R"("lamp", "spectrum_table": [[400, 1], [700, 1]]})");
  SitePaths site;
  site.root = folder.path();
  const Json::Value answer = LibraryAnswer(site);
  EXPECT_TRUE(answer["error"].isNull()) << answer["error"].toStyledString();
  std::map<std::string, Json::Value> found;
  for (const Json::Value& one : answer["materials"]) found[one["name"].asString()] = one;
  ASSERT_TRUE(found.contains("matte") && found.contains("wet"));
  EXPECT_FALSE(found.contains("bare") || found.contains("lamp"));
  EXPECT_EQ(found["matte"]["title"].asString(), "matt one");
  EXPECT_TRUE(found["matte"]["has_table"].asBool());
  EXPECT_FALSE(found["matte"]["mirrors"].asBool());
  EXPECT_NEAR(found["matte"]["rgb"][0].asDouble(), 0.2, 1e-3);
  EXPECT_TRUE(found["wet"]["mirrors"].asBool());
  EXPECT_FALSE(found["wet"]["has_table"].asBool());
  EXPECT_EQ(found["wet"]["rgb"][2].asDouble(), 0.3);
}

TEST(LibraryAnswer, ALibraryAtFaultIsTold) {
  ScratchFolder folder;
  folder.Write("library/broken.json", "{");
  SitePaths site;
  site.root = folder.path();
  const Json::Value answer = LibraryAnswer(site);
  EXPECT_THAT(answer["error"].asString(), testing::HasSubstr("broken.json"));
  EXPECT_EQ(answer["materials"].size(), 0U);
}

}  // namespace
}  // namespace insitu
