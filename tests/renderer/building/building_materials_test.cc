// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_materials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

class Materials : public testing::Test {
 protected:
  BuildingMaterials Read(const std::string& text) {
    return BuildingMaterials::Read(folder_.Write("materials.json", text));
  }
  std::string Complaint(const std::string& text) {
    try {
      Read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

SurfaceNames Names(const std::string& layer, const std::string& block = "",
                   const std::string& material = "") {
  return {layer, block, material, std::nullopt, 1, "", ""};
}

TEST_F(Materials, MaterialGoesBeforeBlockBeforeLayer) {
  BuildingMaterials materials = Read(R"({
    "library": {"oak": {"diffuse_rgb": [0.3, 0.2, 0.1]}},
    "materials": {"Glas": {"diffuse_rgb": [0, 0, 0]}},
    "blocks": {"DOOR": {"use": "oak"}},
    "layers": {"IfcWindow*": {"diffuse_srgb": [255, 255, 255]}, "Ifc*": {"hidden": true},
               "WALL": {"diffuse_lab": [100, 0, 0]}, "Holz": {"diffuse_rgb": [1, 1, 0]}}})");
  EXPECT_EQ(materials.Find(Names("WALL", "DOOR", "Glas"))->surface.name, "Glas");
  EXPECT_EQ(materials.Find(Names("WALL", "DOOR"))->surface.diffuse_rgb, Vector3d(0.3, 0.2, 0.1));
  EXPECT_EQ(materials.Find(Names("wall"))->surface.name, "WALL");
  EXPECT_EQ(materials.Find(Names("x", "", "Holz"))->surface.name, "Holz");  // as OBJ materials
  EXPECT_FALSE(materials.Find(Names("IfcWindow_EG-1"))->hidden);            // the longer pattern
  EXPECT_TRUE(materials.Find(Names("IfcSite_x"))->hidden);
  EXPECT_EQ(materials.Find(Names("roof")), nullptr);
  EXPECT_TRUE(materials.Unused().empty());
}

TEST_F(Materials, ColorsInEveryForm) {
  folder_.Write("brick.csv", "wavelength,value\n400,0.1\n700,0.5\n");
  BuildingMaterials materials = Read(R"({"layers": {
    "a": {"diffuse_srgb": [188, 188, 188]}, "b": {"reflectance": [[400, 0.2], [700, 0.2]]},
    "c": {"reflectance_file": "brick.csv"}}})");
  EXPECT_NEAR(materials.Find(Names("a"))->surface.diffuse_rgb.x(), 0.503, 1e-3);
  EXPECT_NEAR(materials.Find(Names("b"))->surface.diffuse_rgb.y(), 0.2, 1e-3);
  const Vector3d brick = materials.Find(Names("c"))->surface.diffuse_rgb;
  EXPECT_GT(brick.x(), brick.z());
}

TEST_F(Materials, ALibrarysEntryWithKeysOfOnesOwn) {
  folder_.Write("library/alu.json", R"({"kind": "material", "source": "us", "licence": "-",
    "diffuse_rgb": [0, 0, 0], "specular": "conductor", "roughness": 0.2,
    "complex_index": [[400, 0.5, 5], [700, 2, 8]]})");
  folder_.Write("library/wall.json", R"({"kind": "material", "source": "us", "licence": "-",
    "texture": "wall.png", "diffuse_weight": 0.5})");
  Raster white(1, 1);
  white.SetRgb(0, 0, {1, 1, 1});
  WritePng(folder_.path() / "library/wall.png", white, Encoding::kSrgb8);
  const MaterialLibrary library({folder_.path() / "library"});
  const auto read = [&](const std::string& layers) {
    return BuildingMaterials::Read(folder_.Write("materials.json", R"({"library": {"mine":
      {"use": "alu", "roughness": 0.4}}, "layers": {)" + layers + "}}"),
                                   library);
  };
  BuildingMaterials materials = read(R"("a": {"use": "alu"}, "b": {"use": "mine"},
    "c": {"use": "alu", "specular": "none", "reflectance": [[400, 0.5], [700, 0.5]]},
    "d": {"use": "wall"}, "e": {"diffuse_rgb": [0, 0, 0], "proposed": "alu"})");
  EXPECT_EQ(materials.Find(Names("a"))->surface.specular->roughness.slope, 0.2);
  EXPECT_EQ(materials.Find(Names("a"))->surface.name, "a");
  EXPECT_EQ(materials.Find(Names("b"))->surface.specular->roughness.slope, 0.4);
  EXPECT_EQ(materials.Find(Names("b"))->surface.metal->index.size(), 2u);
  EXPECT_FALSE(materials.Find(Names("c"))->surface.specular);
  EXPECT_NEAR(materials.Find(Names("c"))->surface.diffuse_rgb.x(), 0.5, 2e-3);
  EXPECT_EQ(materials.Find(Names("d"))->surface.diffuse_weight, 0.5);
  EXPECT_EQ(materials.Find(Names("d"))->surface.texture, folder_.path() / "library/wall.png");
  EXPECT_NEAR(materials.Find(Names("d"))->surface.diffuse_rgb.x(), 1, 1e-6);
  EXPECT_FALSE(materials.Find(Names("e"))->surface.specular);  // nobody has taken it
  EXPECT_EQ(materials.Proposed(), std::vector<std::string>{"e"});
  EXPECT_THROW(read(R"("a": {"use": "allu"})"), InputError);
}

TEST_F(Materials, BadInput) {
  const auto complaint = [&](const std::string& material) {
    return Complaint("{\"layers\": {\n\"W\": {" + material + "}}}");
  };
  EXPECT_THAT(complaint(""), HasSubstr("names no colour"));
  EXPECT_THAT(complaint(R"("diffuse_srgb": [0, 0, 256])"), HasSubstr("materials.json:2: "));
  EXPECT_THAT(complaint(R"("reflectance": [[500, 1.5], [600, 0]])"), HasSubstr("above 1"));
  EXPECT_THAT(complaint(R"("reflectance": [[500, 0.5], [500, 0]])"), HasSubstr("does not rise"));
  EXPECT_THAT(complaint(R"("reflectance": [[500, 0.5], [700, 0]])"), HasSubstr("does not cover"));
  EXPECT_THAT(complaint(R"("diffuse_rgb": [0, 0, 0], "texture": "no.png")"),
              HasSubstr("no.png, which is not there"));
  EXPECT_THAT(complaint(R"("use": "gold")"),
              HasSubstr("is \"gold\", which is no material of the library"));
}

// Half of its light, though three quarters of its code.
TEST_F(Materials, ATextureSaysTheColour) {
  Raster image(2, 1);
  image.SetRgb(0, 0, {1, 1, 1});
  WritePng(folder_.path() / "wall.png", image, Encoding::kSrgb8);
  const auto text = [](const std::string& size) {
    return R"({"layers": {"WALL": {"texture": "wall.png")" + size + "}}}";
  };
  BuildingMaterials materials = Read(text(R"(, "texture_size_m": [1, 0.8])"));
  const SurfaceMaterial& wall = materials.Find(Names("WALL"))->surface;
  EXPECT_EQ(wall.diffuse_rgb, Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(wall.texture_size, Eigen::Vector2d(1, 0.8));
  EXPECT_EQ(Complaint(text("")), "");
  for (const char* size : {"[1]", "[1, 0]", "[1, 2, 3]"}) {
    EXPECT_THAT(Complaint(text(std::string(R"(, "texture_size_m": )") + size)),
                HasSubstr("materials.json:1: "));
  }
}

}  // namespace
}  // namespace insitu
