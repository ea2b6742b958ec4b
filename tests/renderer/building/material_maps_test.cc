// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/material_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MaterialMaps : public testing::Test {
 protected:
  MaterialMaps() {
    Raster grey(2, 2);
    for (float& value : grey.data) value = 0.5f;
    WriteExr(folder_.path() / "grey.exr", grey);
    surface_.name = "PANEL";
  }
  void Read(const std::string& keys) {
    const JsonNode node = JsonNode::Load(folder_.Write("materials.json", "{\n" + keys + "\n}"));
    ReadMaps(node, folder_.path(), &surface_, &warnings_);
  }
  std::string ErrorOf(const std::string& keys) {
    try {
      Read(keys);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
  SurfaceMaterial surface_;
  std::vector<std::string> warnings_;
};

TEST_F(MaterialMaps, TheirMeansStandForThem) {
  surface_.specular = Specular{1, 1.5};
  surface_.glass = Glass{.weight = 0.8};
  Read(R"("roughness_map": "grey.exr", "roughness_map_is": "root", "transmission_map": "grey.exr",
         "height_map": "grey.exr", "height_m": 0.02)");
  ASSERT_EQ(surface_.maps.size(), 3u);
  EXPECT_NEAR(surface_.specular->roughness.slope, 0.25, 1e-6);
  EXPECT_NEAR(surface_.glass->weight, 0.4, 1e-6);
  EXPECT_EQ(surface_.maps[2].factor, 0.02);
  EXPECT_EQ(surface_.maps[0].file, "grey.exr");
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(MaterialMaps, OneThatIsNotThereIsNamedAndTheRestKept) {
  folder_.Write("text.png", "no image");
  Read("\"normal_map\": \"away.png\",\n\"height_map\": \"grey.exr\", \"height_m\": 0.1");
  EXPECT_EQ(surface_.maps.size(), 1u);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("normal_map is left out of \"PANEL\"")));
  EXPECT_THAT(warnings_[0], HasSubstr("materials.json:2:"));
  Read("\"normal_map\": \"text.png\"");
  EXPECT_THAT(warnings_[1], HasSubstr("text.png"));
}

TEST_F(MaterialMaps, WhatTheyNeedIsAskedFor) {
  EXPECT_THAT(ErrorOf("\"roughness_map\": \"grey.exr\""), HasSubstr("json:2: "));
  EXPECT_THAT(ErrorOf("\"roughness_map\": \"grey.exr\""), HasSubstr("needs specular"));
  EXPECT_THAT(ErrorOf("\"transmission_map\": \"grey.exr\""), HasSubstr("needs transmission"));
  EXPECT_THAT(ErrorOf("\"height_map\": \"grey.exr\""), HasSubstr("height_m"));
  EXPECT_THAT(ErrorOf("\"height_map\": \"grey.exr\",\n\"height_m\": 0"), HasSubstr("json:3: "));
  EXPECT_THAT(ErrorOf("\"roughness_map_is\": \"gloss\""), HasSubstr("expected slope or root"));
}

TEST_F(MaterialMaps, OfAModelMakeACoatOrBareMetal) {
  SurfaceNames names;
  const std::string grey = (folder_.path() / "grey.exr").string();
  names.maps = {{.kind = SurfaceMap::Kind::kMetallic, .file = grey},
                {.kind = SurfaceMap::Kind::kNormal, .file = folder_.path() / "away.png"}};
  AddModelMaps(names, folder_.path(), &surface_, &warnings_);
  ASSERT_EQ(surface_.maps.size(), 1u);
  EXPECT_EQ(surface_.maps[0].file, "grey.exr");
  EXPECT_NEAR(surface_.maps[0].mean, 0.5, 1e-6);
  EXPECT_EQ(surface_.specular->index, 1.5);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("left out of \"PANEL\"")));
}

}  // namespace
}  // namespace insitu
