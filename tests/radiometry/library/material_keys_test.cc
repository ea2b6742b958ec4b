// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/library/material_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;

TEST(MaterialKeys, TheUppermostEntryCounts) {
  const ScratchFolder folder;
  MaterialKeys keys(JsonNode::Load(folder.Write("own.json", R"({"roughness": 0.1, "b": null})")));
  keys.PutBelow(JsonNode::Load(folder.Write("steel.json", R"({"roughness": 0.3,
    "b": 2, "specular": "mirror", "reflectance": 5})")));
  EXPECT_EQ(keys.At("roughness").Number(), 0.1);
  EXPECT_EQ(keys.At("b").Number(), 2);
  EXPECT_EQ(keys.At("specular").Text(), "mirror");
  EXPECT_FALSE(keys.Find("ior"));
  EXPECT_EQ(keys.WithAnyOf({"ior", "roughness"})->At("roughness").Number(), 0.1);
  EXPECT_TRUE(keys.WithAnyOf({"specular"})->Find("reflectance"));
  EXPECT_FALSE(keys.WithAnyOf({"ior"}));
}

TEST(MaterialKeys, FaultsNameTheFileThatHasThem) {
  const ScratchFolder folder;
  MaterialKeys keys(JsonNode::Load(folder.Write("own.json", "{}")));
  keys.PutBelow(JsonNode::Load(folder.Write("steel.json", "{\n\"ior\": 0.5}")));
  EXPECT_THAT(keys.At("ior").Error("is low").what(), HasSubstr("steel.json:2"));
  EXPECT_THAT(keys.Error("is empty").what(), HasSubstr("own.json"));
  EXPECT_THROW(keys.At("roughness"), InputError);
}

}  // namespace
}  // namespace insitu
