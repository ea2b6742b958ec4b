// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/material_optics.h"

#include <gtest/gtest.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

SurfaceMaterial Read(const std::string& keys) {
  const ScratchFolder folder;
  SurfaceMaterial surface;
  ReadOptics(JsonNode::Load(folder.Write("materials.json", "{\n" + keys + "\n}")), &surface);
  return surface;
}

std::string ErrorOf(const std::string& keys) {
  try {
    Read(keys);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReadOptics, PanesAndBodies) {
  const SurfaceMaterial pane = Read(
      R"("specular": "fresnel", "ior": 1.52, "transmission": 0.8, "thin": true,
         "thickness_m": 0.01, "absorption_per_m": [9, 3, 4.5])");
  ASSERT_TRUE(pane.glass);
  EXPECT_FALSE(pane.glass->is_solid);
  EXPECT_EQ(pane.glass->weight, 0.8);
  EXPECT_EQ(pane.glass->index, 1.52);
  EXPECT_EQ(pane.glass->thickness, 0.01);
  EXPECT_EQ(pane.glass->absorption_rgb, Eigen::Vector3d(9, 3, 4.5));
  EXPECT_TRUE(Read(R"("transmission": 1, "solid": true)").glass->is_solid);
  EXPECT_FALSE(Read(R"("transmission": 0)").glass);
  EXPECT_FALSE(Read(R"("transmission": null)").glass);
}

TEST(ReadOptics, Metals) {
  const SurfaceMaterial bronze =
      Read(R"("specular": "mirror", "roughness": 0.09, "specular_rgb": [0.78, 0.5, 0.31])");
  EXPECT_EQ(bronze.specular_rgb, Eigen::Vector3d(0.78, 0.5, 0.31));
  EXPECT_EQ(bronze.specular->roughness.slope, 0.09);
  const SurfaceMaterial gold =
      Read(R"("specular": "conductor", "complex_index": [[400, 1.5, 1.9], [700, 0.2, 3.9]])");
  ASSERT_TRUE(gold.metal);
  EXPECT_EQ(gold.metal->index[1], Eigen::Vector2d(700, 0.2));
  EXPECT_EQ(gold.metal->extinction[0], Eigen::Vector2d(400, 1.9));
}

TEST(ReadOptics, Translucence) {
  EXPECT_EQ(Read(R"("translucent_rgb": [0.3, 0.4, 0.5])").translucent_rgb,
            Eigen::Vector3d(0.3, 0.4, 0.5));
  const SurfaceMaterial leaf = Read(R"("translucent_table": [[380, 0.1], [780, 0.1]])");
  EXPECT_EQ(leaf.translucent[1], Eigen::Vector2d(780, 0.1));
  EXPECT_NEAR(leaf.translucent_rgb.y(), 0.1, 1e-4);
}

TEST(ReadOptics, FaultsNameTheLine) {
  const auto expect = [](const std::string& keys, int line, const std::string& message) {
    const std::string error = ErrorOf(keys);
    EXPECT_NE(error.find("materials.json:" + std::to_string(line) + ":"), std::string::npos)
        << error;
    EXPECT_NE(error.find(message), std::string::npos) << error;
  };
  expect("\"specular\": \"fresnel\",\n\"ior\": 0.9", 3, "expected above 1");
  expect("\"transmission\": 1.5", 2, "expected 0 to 1");
  expect("\"transmission\": 1,\n\"thin\": true,\n\"solid\": true", 3, "beside solid");
  expect("\"transmission\": 1,\n\"absorption_per_m\": [1, -2, 3]", 3, "is negative");
  expect("\"transmission\": 1,\n\"thickness_m\": -1", 3, "is negative");
  expect("\"specular_rgb\": [1, 2, 3]", 2, "from 0 to 1");
  expect("\"translucent_rgb\": [0.1, -0.1, 0]", 2, "from 0 to 1");
  expect("\"translucent_rgb\": [0.4, 0.6, 0]", 2, "no more light than falls on it");  // of 0.5 grey
  expect("\"transmission\": 1,\n\"translucent_rgb\": [0.4, 0.4, 0]", 3, "beside transmission");
  expect("\"translucent_table\": [[500, 0.1], [780, 0.1]]", 2, "does not cover");
  expect("\"specular\": \"conductor\",\n\"complex_index\": [[500, 1, 1], [600, 1, 1]]", 3,
         "does not cover the visible range");
  expect("\"specular\": \"conductor\",\n\"complex_index\": [[400, 1, 1], [390, 1, 1]]", 3,
         "does not rise");
  expect("\"specular\": \"conductor\",\n\"complex_index\": [[400, 0, 1], [790, 1, 1]]", 3,
         "is no complex index");
}

}  // namespace
}  // namespace insitu
