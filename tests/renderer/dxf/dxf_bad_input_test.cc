// SPDX-License-Identifier: GPL-3.0-or-later
// Faulty drawings: each gives one message that names the line, and none crashes the reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "calibration/files/error.h"
#include "renderer/dxf/dxf.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/dxf/dxf_text.h"

namespace insitu {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

// What ReadDxf says of a drawing; empty if it takes it.
std::string Complaint(const std::string& text) {
  static const ScratchFolder folder;
  try {
    ReadDxf(folder.Write("drawing.dxf", text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// The line of the only occurrence of `value` in the drawing.
int LineOf(const std::string& text, const std::string& value) {
  const size_t at = text.find("\n" + value + "\n");
  EXPECT_EQ(text.find("\n" + value + "\n", at + 1), std::string::npos);
  return static_cast<int>(std::count(text.begin(), text.begin() + at, '\n')) + 2;
}

// Expects the complaint to be about `value`, at its line.
void ExpectFault(const std::string& text, const std::string& value, const std::string& message) {
  const std::string place = "drawing.dxf:" + std::to_string(LineOf(text, value)) + ": ";
  EXPECT_THAT(Complaint(text), HasSubstr(place));
  EXPECT_THAT(Complaint(text), HasSubstr(message));
}

const char kPolyface[] = R"(
  0 POLYLINE
  70 64
  0 VERTEX
  70 192
  10 0
  20 0
  0 VERTEX
  70 192
  10 1
  20 0
  0 VERTEX
  70 192
  10 0
  20 1
  0 VERTEX
  70 128
  71 1
  72 2
  73 CORNER
  0 SEQEND
)";

const char kMesh[] = R"(
  0 MESH
  100 AcDbSubDMesh
  92 3
  10 0
  20 0
  30 0
  10 1
  20 0
  30 0
  10 0
  20 1
  30 0
  93 SIZE
  90 3
  90 0
  90 1
  90 CORNER
)";

std::string Replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

std::string Mesh(const std::string& size, const std::string& corner) {
  return DrawingText(Replaced(Replaced(kMesh, "SIZE", size), "CORNER", corner));
}

TEST(DxfBadInput, CutAtAnyByte) {
  const std::string whole =
      DrawingText(Replaced(kPolyface, "CORNER", "3") +
                      Replaced(Replaced(kMesh, "SIZE", "4"), "CORNER", "2") + "0 INSERT\n2 B\n",
                  "0 BLOCK\n2 B\n" + UnitSquare("W") + "0 ENDBLK\n");
  ASSERT_EQ(Complaint(whole), "");
  ASSERT_THAT(whole, EndsWith("EOF\n"));
  for (size_t length = 0; length + 1 < whole.size(); ++length) {
    EXPECT_THAT(Complaint(whole.substr(0, length)), HasSubstr("it is cut short")) << length;
  }
  EXPECT_EQ(Complaint(whole.substr(0, whole.size() - 1)), "");
}

TEST(DxfBadInput, CutDrawingNamesItsLastLine) {
  EXPECT_THAT(Complaint(DxfText("0 SECTION\n2 ENTITIES\n")), HasSubstr("drawing.dxf:4: "));
}

TEST(DxfBadInput, NeverCrashesOnDamagedDrawings) {
  const std::string whole = DrawingText(
      Replaced(kPolyface, "CORNER", "3") + "0 INSERT\n2 B\n70 2\n44 1\n",
      "0 BLOCK\n2 B\n" + Replaced(Replaced(kMesh, "SIZE", "4"), "CORNER", "2") + "0 ENDBLK\n");
  std::mt19937 random(20240601);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = whole;
    for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
    refused += !Complaint(damaged).empty();
  }
  EXPECT_GT(refused, 150);
  for (int trial = 0; trial < 100; ++trial) {
    std::string garbage(random() % 2000, '\0');
    for (char& c : garbage) c = static_cast<char>(random());
    EXPECT_NE(Complaint(garbage), "");
  }
}

TEST(DxfBadInput, OtherFormats) {
  EXPECT_THAT(Complaint(std::string("AutoCAD Binary DXF\r\n\x1a\0", 22)),
              HasSubstr("byte 22: the drawing ends here"));
  EXPECT_THAT(Complaint("AC1032 ..."), HasSubstr("DWG"));
  EXPECT_THAT(Complaint("ISO-10303-21;\nHEADER;\n"), HasSubstr("drawing.dxf:1: \"ISO-10303-21;\""));
  EXPECT_THAT(Complaint("10\n1\n0\nEOF\n"), HasSubstr("drawing.dxf:1: a drawing begins"));
}

TEST(DxfBadInput, Numbers) {
  for (const std::string value : {"1e300", "1,5", "wide"}) {
    const std::string face = Replaced(UnitSquare("W"), "22 1", "22 " + value);
    ExpectFault(DrawingText(face), value, "expected a number of at most 1e12 for group 22");
  }
  const std::string face = Replaced(UnitSquare("W"), "22 1\n", "");
  EXPECT_THAT(Complaint(DrawingText(face)), HasSubstr("group 12 (x) has no group 22 (y)"));
  EXPECT_THAT(Complaint(DrawingText("0 3DFACE\n10 1\n20 1\n")), HasSubstr("3DFACE has no point"));
  ExpectFault(DrawingText("0 INSERT\n2 B\n70 many\n"), "many", "expected an integer for group 70");
  ExpectFault(DrawingText("0 INSERT\n2 B\n70 -3\n"), "-3", "expected none or more");
  ExpectFault(DrawingText("0 INSERT\n210 0.0\n220 0\n230 0\n"), "0.0", "extrusion direction");
}

TEST(DxfBadInput, LittleCostsOnlyItself) {
  EXPECT_EQ(Complaint(DrawingText(UnitSquare("W") + "0 INSERT\n2 NOWHERE\n")), "");
  EXPECT_EQ(Complaint(DrawingText(UnitSquare("W") + "5001 private\n420 3271557125\n62 7.0\n")), "");
}

TEST(DxfBadInput, WhatIsLostIsCounted) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& text) { return ReadDxf(folder.Write("a.dxf", text)); };
  const auto skipped = [](const Model& model, const std::string& kind) {
    int count = 0;
    for (const auto& [what, number] : model.skipped) count += what.first == kind ? number : 0;
    return count;
  };
  for (const std::string value : {"nan", "-nan(ind)", "-1.#IND", "inf"}) {
    const Model model =
        read(DrawingText(UnitSquare("W") + Replaced(UnitSquare("W"), "22 1", "22 " + value)));
    EXPECT_EQ(model.mesh.triangles.size(), 2u) << value;
    EXPECT_EQ(skipped(model, "3DFACE"), 1) << value;
  }
  // Of a POLYLINE in its head or a vertex: it goes, with all its vertices.
  const std::string wall =
      "0 POLYLINE\n8 P\n66 1\n30 0\n39 2\n0 VERTEX\n8 P\n10 0\n20 0\n0 VERTEX\n8 P\n10 4\n20 0\n"
      "0 SEQEND\n";
  EXPECT_EQ(read(DrawingText(wall + UnitSquare("W"))).mesh.triangles.size(), 4u);
  for (const char* at : {"30 0", "39 2", "20 0\n0 SEQEND"}) {
    const std::string torn = Replaced(wall, at, std::string(at, 2) + " nan" + (at + 4));
    const Model model = read(DrawingText(torn + UnitSquare("W")));
    EXPECT_EQ(model.mesh.triangles.size(), 2u) << at;
    EXPECT_EQ(skipped(model, "POLYLINE"), 1) << at;
  }
  const Model colored = read(DrawingText(UnitSquare("W") + "420 42949672960\n62 red\n"));
  EXPECT_EQ(colored.mesh.triangles.size(), 2u);
  EXPECT_EQ(skipped(colored, "colour"), 2);
  const Model looks = read(DrawingText(UnitSquare("W") + "62 999\n440 33554559\n347 2A\n" +
                                       UnitSquare("W") + "62 256\n440 33554687\n"));
  EXPECT_EQ(skipped(looks, "colour"), 1);
  EXPECT_EQ(skipped(looks, "transparency"), 1);
  EXPECT_EQ(skipped(looks, "material"), 1);
  const Model unknown =
      read(DxfText("0 SECTION\n2 HEADER\n9 $INSUNITS\n70 99\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n" +
                   UnitSquare("W") + "0 ENDSEC\n0 EOF"));
  EXPECT_EQ(unknown.metres_per_unit, std::nullopt);
  ASSERT_EQ(unknown.warnings.size(), 1u);
  EXPECT_THAT(unknown.warnings[0], HasSubstr("a.dxf:8: $INSUNITS is 99, no unit that is known"));
}

TEST(DxfBadInput, FacesOutOfRange) {
  ExpectFault(DrawingText(Replaced(kPolyface, "CORNER", "-4")), "-4",
              "names vertex 4, expected 1 to 3");
  ExpectFault(DrawingText(Replaced(kPolyface, "CORNER", "-2147483648")), "-2147483648",
              "names vertex 2147483648");
  ExpectFault(Mesh("4", "77"), "77", "names vertex 77, expected 0 to 2");
  ExpectFault(Mesh("4", "-1"), "-1", "names vertex -1");
}

TEST(DxfBadInput, CountsThatDoNotAgree) {
  ASSERT_EQ(Complaint(Mesh("4", "2")), "");
  EXPECT_THAT(Complaint(Mesh("5", "2")), HasSubstr("expected group code 90"));
  EXPECT_THAT(Complaint(Mesh("3", "2")), HasSubstr("take 4 numbers, not 3"));
  EXPECT_THAT(Complaint(DrawingText("0 MESH\n100 AcDbSubDMesh\n92 1000000000\n10 0\n20 0\n30 0")),
              HasSubstr("expected group code 10"));
  EXPECT_THAT(Complaint(DrawingText(Replaced(Replaced(kMesh, "SIZE", "4"), "90 3", "90 2"))),
              HasSubstr("3 corners"));
  ExpectFault(DrawingText("0 POLYLINE\n70 16\n71 70000\n72 70001\n0 SEQEND"), "POLYLINE",
              "a polygon mesh of 70000 x 70001 vertices has 0 of them");
}

TEST(DxfBadInput, UnclosedParts) {
  ExpectFault(DxfText("0 SECTION\n2 ENTITIES\n0 EOF"), "SECTION", "expected an ENDSEC");
  ExpectFault(DrawingText("", "0 BLOCK\n2 B\n"), "BLOCK", "expected an ENDBLK");
}

TEST(DxfBadInput, BlocksThatInsertThemselves) {
  const std::string blocks =
      "0 BLOCK\n2 A\n0 INSERT\n2 B\n0 ENDBLK\n"
      "0 BLOCK\n2 B\n0 INSERT\n2 a\n0 ENDBLK\n";
  EXPECT_EQ(Complaint(DrawingText("", blocks)), "");  // harmless if never used
  const ScratchFolder folder;
  const Model model =
      ReadDxf(folder.Write("a.dxf", DrawingText(UnitSquare("W") + "0 INSERT\n2 A", blocks)));
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
  EXPECT_EQ(model.skipped.at({"INSERT", "of block \"a\", which it is within"}), 1);
}

// Block k holds two of block k + 1: 2^60 copies, or a chain too deep.
std::string NestedBlocks(int depth, int copies) {
  std::string blocks;
  for (int k = 0; k < depth; ++k) {
    blocks += "0 BLOCK\n2 B" + std::to_string(k) + "\n";
    for (int i = 0; i < copies && k + 1 < depth; ++i) {
      blocks += "0 INSERT\n2 B" + std::to_string(k + 1) + "\n";
    }
    blocks += "0 ENDBLK\n";
  }
  return blocks;
}

TEST(DxfBadInput, TooManyOrTooDeepBlocks) {
  EXPECT_THAT(Complaint(DrawingText("0 INSERT\n2 B0", NestedBlocks(60, 2))),
              HasSubstr("over 20 million pieces"));
  EXPECT_EQ(Complaint(DrawingText("0 INSERT\n2 B0", NestedBlocks(64, 1))), "");
  EXPECT_THAT(Complaint(DrawingText("0 INSERT\n2 B0", NestedBlocks(65, 1))),
              HasSubstr("more than 64 deep"));
  EXPECT_THAT(Complaint(DrawingText("0 INSERT\n2 B40\n0 INSERT\n2 B0", NestedBlocks(65, 1))),
              HasSubstr("more than 64 deep"));
  ExpectFault(DrawingText("0 INSERT\n2 B\n70 1000000\n71 1000000",
                          "0 BLOCK\n2 B\n" + UnitSquare("W") + "0 ENDBLK"),
              "INSERT", "over 20 million pieces");
}

TEST(DxfBadInput, TenThousandNestedBlocks) {
  EXPECT_THAT(Complaint(DrawingText("0 INSERT\n2 B0", NestedBlocks(10000, 1))),
              HasSubstr("more than 64 deep"));
}

TEST(DxfBadInput, InsertsThatGrowWithoutBound) {
  const std::string blocks =
      "0 BLOCK\n2 A\n0 INSERT\n2 B\n41 1e9\n0 ENDBLK\n"
      "0 BLOCK\n2 B\n" +
      UnitSquare("W") + "0 ENDBLK\n";
  EXPECT_THAT(Complaint(DrawingText("0 INSERT\n2 A\n41 1e9", blocks)), HasSubstr("beyond 1e12 m"));
}

}  // namespace
}  // namespace insitu
