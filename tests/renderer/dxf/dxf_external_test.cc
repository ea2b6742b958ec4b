// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>

#include "renderer/dxf/dxf.h"
#include "renderer/dxf/dxf_drawing.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/dxf/dxf_text.h"

namespace insitu {
namespace {

std::string ExternalBlock(const std::string& name, const std::string& file, int flags = 4) {
  return "0 BLOCK\n 8 0\n 2 " + name + "\n 70 " + std::to_string(flags) + "\n 1 " + file +
         "\n 0 ENDBLK\n";
}

std::string Insert(const std::string& block, const std::string& more = "") {
  return "0 INSERT\n 8 SITE\n 2 " + block + "\n" + more;
}

std::string ReasonOf(const Model& model, const std::string& kind) {
  for (const auto& [what, count] : model.skipped) {
    if (what.first == kind) return what.second;
  }
  return "";
}

TEST(DxfExternal, DrawingIsReadWhereItsInsertPutsIt) {
  const ScratchFolder folder;
  folder.Write("Grid.dxf", DrawingText(UnitSquare("WALLS") + UnitSquare("0", "1")));
  const Model model = ReadDxf(folder.Write(
      "house.dxf", DrawingText(Insert("grid", "10 100\n 20 50\n 30 0\n 41 2\n 42 2\n 43 2\n"),
                               ExternalBlock("grid", "C:\\CAD\\grid.dwg"))));
  const Eigen::AlignedBox3d box = BoxOf(model.mesh);
  EXPECT_EQ(box.min(), Eigen::Vector3d(100, 50, 0));
  EXPECT_EQ(box.max(), Eigen::Vector3d(102, 52, 2));
  ASSERT_EQ(model.mesh.surfaces.size(), 2u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "grid|WALLS");
  EXPECT_EQ(model.mesh.surfaces[1].layer, "SITE");  // 0 is the INSERT's
  EXPECT_EQ(model.mesh.surfaces[0].block, "grid");
  ASSERT_EQ(model.files.size(), 1u);
  EXPECT_EQ(model.files[0].filename(), "Grid.dxf");
  EXPECT_TRUE(model.skipped.empty());
}

TEST(DxfExternal, HostsLayersDecideWhatIsShown) {
  const ScratchFolder folder;
  folder.Write("grid.dxf", DrawingText(UnitSquare("WALLS") + UnitSquare("ROOF")));
  const std::string text =
      DxfText("0 SECTION\n 2 TABLES\n 0 LAYER\n 2 grid|ROOF\n 70 1\n 62 7\n 0 ENDSEC\n") +
      DrawingText(Insert("grid"), ExternalBlock("grid", "grid.dxf"));
  const Model model = ReadDxf(folder.Write("house.dxf", text));
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
  EXPECT_EQ(ReasonOf(model, "3DFACE"), "layer \"grid|ROOF\" is frozen");
}

TEST(DxfExternal, BlocksOfOneNameAreKeptApart) {
  const ScratchFolder folder;
  const std::string block = "0 BLOCK\n 2 WINDOW\n 70 0\n";
  folder.Write("grid.dxf", DrawingText(Insert("WINDOW"), block + UnitSquare("A") + "0 ENDBLK\n"));
  const Model model =
      ReadDxf(folder.Write("house.dxf", DrawingText(Insert("grid") + Insert("WINDOW"),
                                                    block + UnitSquare("A", "5") + "0 ENDBLK\n" +
                                                        ExternalBlock("grid", "grid.dwg"))));
  ASSERT_EQ(model.mesh.surfaces.size(), 2u);
  EXPECT_EQ(model.mesh.surfaces[0].block, "grid|WINDOW");
  EXPECT_EQ(model.mesh.surfaces[1].block, "WINDOW");
  EXPECT_EQ(BoxOf(model.mesh).max().z(), 5);
}

TEST(DxfExternal, OverlaysOfDrawingsWithinAreNotShown) {
  const ScratchFolder folder;
  folder.Write("c.dxf", DrawingText(UnitSquare("C")));
  folder.Write("b.dxf", DrawingText(UnitSquare("B") + Insert("c"), ExternalBlock("c", "c.dxf", 8)));
  const std::string b = ExternalBlock("b", "b.dxf", 8);
  const Model model = ReadDxf(folder.Write("a.dxf", DrawingText(Insert("b"), b)));
  ASSERT_EQ(model.mesh.surfaces.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "b|B");
  EXPECT_NE(ReasonOf(model, "INSERT").find("overlay"), std::string::npos);
}

TEST(DxfExternal, DrawingsThatReferToEachOtherEnd) {
  const ScratchFolder folder;
  folder.Write("b.dxf", DrawingText(UnitSquare("B") + Insert("a"), ExternalBlock("a", "a.dwg")));
  const auto a = folder.Write("a.dxf", DrawingText(Insert("b"), ExternalBlock("b", "b.dwg")));
  const Model model = ReadDxf(a);
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
  EXPECT_NE(ReasonOf(model, "INSERT").find("which it is within"), std::string::npos);
}

TEST(DxfExternal, WhatIsNotReadSaysWhatToDo) {
  const ScratchFolder folder;
  folder.Write("plan.dwg", "AC1032 and so on");
  folder.Write("bad.dxf", DxfText("0 SECTION\n 2 ENTITIES\n 0 3DFACE\n"));
  const auto reason = [&](const std::string& file) {
    const auto text = DrawingText(Insert("x"), ExternalBlock("x", file));
    return ReasonOf(ReadDxf(folder.Write("house.dxf", text)), "INSERT");
  };
  EXPECT_NE(reason("D:\\x\\plan.dwg").find("save it as DXF beside it (plan.dxf)"),
            std::string::npos);
  EXPECT_NE(reason("gone.dwg").find("not there: put it beside the drawing as DXF (gone.dxf)"),
            std::string::npos);
  EXPECT_NE(reason("bad.dwg").find("cannot be read"), std::string::npos);
}

TEST(DxfExternal, UnitsThatDoNotFitTheInsertAreToldOf) {
  const ScratchFolder folder;
  folder.Write("mm.dxf", DxfText("0 SECTION\n 2 HEADER\n 9 $INSUNITS\n 70 4\n 0 ENDSEC\n" +
                                 EntitiesSection(UnitSquare("A")) + "0 EOF\n"));
  const auto read = [&](const std::string& scale) {
    const std::string more = "41 " + scale + "\n 42 " + scale + "\n 43 " + scale + "\n";
    return ReadDxf(
        folder.Write("house.dxf", DrawingText(Insert("mm", more), ExternalBlock("mm", "mm.dxf"))));
  };
  EXPECT_TRUE(read("0.001").warnings.empty());
  ASSERT_EQ(read("1").warnings.size(), 1u);
  EXPECT_NE(read("1").warnings[0].find("0.001 times"), std::string::npos);
}

}  // namespace
}  // namespace insitu
