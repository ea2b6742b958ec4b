// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/dxf/dxf_text.h"
#include "tests/renderer/formats/model_texts.h"

namespace insitu {
namespace {

using testing::HasSubstr;

TEST(ModelFormat, IsToldByContent) {
  const ScratchFolder folder;
  const std::pair<std::string, ModelFormat> cases[] = {
      {DrawingText(UnitSquare("W")), ModelFormat::kDxf},
      {"999\nby hand\n0\nSECTION\n", ModelFormat::kDxf},
      {kObj, ModelFormat::kObj},
      {kPly, ModelFormat::kPly},
      {kStl, ModelFormat::kStl},
      {kGltf, ModelFormat::kGltf},
      {kCollada, ModelFormat::kCollada},
      {"ISO-10303-21;\nHEADER;", ModelFormat::kIfc}};
  for (const auto& [content, format] : cases) {
    EXPECT_EQ(DetectModelFormat(folder.Write("anything.txt", content)), format);
  }
  EXPECT_EQ(DetectModelFormat(folder.Write("anything.obj", "hello\n")), std::nullopt);
  EXPECT_EQ(DetectModelFormat(folder.Write("anything.obj", "hello\nv 0 -1.5 2e3\n")),
            ModelFormat::kObj);
  std::string wide = "\xFF\xFE";
  for (const char c : std::string(kObj)) wide += {c, '\0'};
  EXPECT_EQ(DetectModelFormat(folder.Write("anything.txt", wide)), ModelFormat::kObj);
  const std::string late = "{\"buffers\": [\"" + std::string(100000, 'A') + "\"], \"asset\": 1}";
  EXPECT_EQ(DetectModelFormat(folder.Write("a.gltf", late)), ModelFormat::kGltf);
}

TEST(ModelFormat, WhatIsNotReadIsNamed) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& name, const std::string& content) -> std::string {
    try {
      RequireModelFormat(folder.Write(name, content));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint("a.obj", "AC1032 ..."), HasSubstr("is a DWG drawing"));
  EXPECT_THAT(complaint("a.3dm", "3D Geometry File Format "), HasSubstr("is a Rhino model"));
  EXPECT_THAT(complaint("a.skp", "PK\x03\x04"), HasSubstr("SketchUp File > Export > 3D Model"));
  EXPECT_THAT(complaint("a.fbx", "; FBX 7.4.0 project file"), HasSubstr("an FBX model as text"));
  EXPECT_THAT(complaint("a.fbx", "Kaydara FBX Binary"), HasSubstr("in Blender File > Import"));
  EXPECT_THAT(complaint("a.gsm", "...."), HasSubstr("is an ArchiCAD library part"));
  EXPECT_THAT(complaint("a.max", "\xD0\xCF\x11\xE0"), HasSubstr("is a 3ds Max scene"));
  EXPECT_THAT(complaint("a.zip", "PK\x03\x04"), HasSubstr("unpack it into building/"));
  EXPECT_THAT(complaint("a.obj", "PK\x03\x04"), HasSubstr("unpack it into building/"));
  EXPECT_THAT(complaint("a", "MM d...."), HasSubstr("is a 3DS model"));
  EXPECT_THAT(complaint("a", std::string("MM\0*....", 8)), HasSubstr("is no model that is read"));
  EXPECT_THAT(complaint("a.ifc", "<!DOCTYPE html>"), HasSubstr("is a web page"));
  EXPECT_THAT(complaint("a.obj", ""), HasSubstr("is empty"));
  const std::string step = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\n";
  EXPECT_THAT(complaint("a.ifc", step), HasSubstr("is a STEP model"));
  EXPECT_EQ(DetectModelFormat(folder.Write("b.step", step)), std::nullopt);
  EXPECT_THAT(complaint("a.json", R"({"type":"CityJSON","version":"1.1"})"),
              HasSubstr("is a CityJSON model"));
  EXPECT_EQ(complaint("a.dxf", "hello"), "");  // its reader says what is wrong
}

}  // namespace
}  // namespace insitu
