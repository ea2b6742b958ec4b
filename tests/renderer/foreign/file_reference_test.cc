// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/file_reference.h"

#include <gtest/gtest.h>

#include "renderer/foreign/text_lines.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(FileReference, IsFoundAsOtherMachinesNameIt) {
  const ScratchFolder folder;
  const auto model = folder.Write("house.obj", "");
  const auto image = std::filesystem::absolute(folder.Write("maps/brick wall.png", ""));
  for (const char* name :
       {"maps/brick wall.png", "maps\\brick wall.png", "\"MAPS/Brick Wall.PNG\"",
        "C:\\Anna\\maps\\brick wall.png", "\\\\server\\maps\\brick wall.png",
        "file:///C:/Anna/maps/brick%20wall.png", "maps/brick%20wall.png",
        "D:\\other\\brick wall.png", "brick%20wall.png", "maps/brick wall.png?v=3",
        "https://host/a/maps/brick%20wall.png?w=1/2#top", "brick wall.png#1"}) {
    EXPECT_EQ(FindReference(model, name), image.lexically_normal()) << name;
  }
  const auto umlaut = std::filesystem::absolute(folder.Write("maps/Gr\xC3\xBCn.png", ""));
  EXPECT_EQ(FindReference(model, "maps/GR\xC3\x9CN.png"), umlaut.lexically_normal());
  EXPECT_EQ(FindReference(model, "maps/Gru\xCC\x88n.png"), umlaut.lexically_normal());
  const auto marked = std::filesystem::absolute(folder.Write("maps/what?.png", ""));
  EXPECT_EQ(FindReference(model, "maps/what?.png"), marked.lexically_normal());
  EXPECT_EQ(FindReference(model, "?v=3"), std::nullopt);
  EXPECT_EQ(FindReference(model, "other.png"), std::nullopt);
  EXPECT_EQ(FindReference(model, ""), std::nullopt);
}

TEST(TextLines, Utf16OfEitherByteOrder) {
  const std::string text("\xE4\0\x3D\xD8\x00\xDE", 6);
  EXPECT_EQ(Utf8FromUtf16(text, true), "\xC3\xA4\xF0\x9F\x98\x80");
  EXPECT_EQ(Utf8FromUtf16(std::string("\0\xE4", 2), false), "\xC3\xA4");
}

TEST(TextLines, Utf16IsToldWithoutAMark) {
  std::string wide;
  for (const char c : std::string("o Haus\nv 0 0 0\n")) wide += {c, '\0'};
  EXPECT_EQ(DecodedText(wide), "o Haus\nv 0 0 0\n");
  EXPECT_EQ(DecodedText("\xFF\xFE" + wide), "o Haus\nv 0 0 0\n");
  EXPECT_FALSE(IsUtf16("\xFF\xFE\xFF\x0ES"));  // SketchUp
  EXPECT_FALSE(IsUtf16(std::string(80, '\0')));
}

}  // namespace
}  // namespace insitu
