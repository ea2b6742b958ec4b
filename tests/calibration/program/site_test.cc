// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/site.h"

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(HasPhotographEnding, IsThatOfAFormatThatIsRead) {
  for (const char* name :
       {"a.jpg", "a.JPG", "a.jpeg", "a.png", "a.tif", "a.tiff", "a.exr", "a.dng", "a.NEF"}) {
    EXPECT_TRUE(HasPhotographEnding(name)) << name;
  }
  for (const char* name : {"a.heic", "a.csv", "jpg", "a.jpg.txt", ""}) {
    EXPECT_FALSE(HasPhotographEnding(name)) << name;
  }
}

TEST(IsPhotograph, IsAFileThatIsThereAndNotHidden) {
  const ScratchFolder folder;
  EXPECT_TRUE(IsPhotograph(folder.Write("a.jpg", "")));
  EXPECT_FALSE(IsPhotograph(folder.Write(".a.jpg", "")));
  EXPECT_FALSE(IsPhotograph(folder.path() / "b.jpg"));
  std::filesystem::create_directory(folder.path() / "c.jpg");
  EXPECT_FALSE(IsPhotograph(folder.path() / "c.jpg"));
}

TEST(SitePaths, AVariantHasWhatIsOfItsDesignApart) {
  const SitePaths site{"site"}, tall{"site", "tall"};
  EXPECT_EQ(site.building(), "site/building");
  EXPECT_EQ(tall.building(), "site/variants/tall");
  EXPECT_EQ(tall.montages(), "site/montages/tall");
  EXPECT_EQ(tall.artificial(), "site/work/variants/tall/building.json");
  EXPECT_NE(tall.partial_render("a"), site.partial_render("a"));
  EXPECT_EQ(tall.environment(), site.environment());
  EXPECT_EQ(tall.lock(), site.lock());
}

TEST(RequireVariant, NamesThoseThereAre) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(RequireVariant({folder.path()}));
  EXPECT_EQ(InputErrorOf([&] {
              RequireVariant({folder.path(), "tal"});
            }),
            (folder.path() / "variants").string() +
                ": has no folder \"tal\", expected one, with the content of building/");
  folder.Write("variants/tall/a.dxf", "");
  folder.Write("variants/low/a.dxf", "");
  EXPECT_NO_THROW(RequireVariant({folder.path(), "tall"}));
  for (const std::string name : {"tal", "..", "tall/", "../building"}) {
    EXPECT_EQ(InputErrorOf([&] {
                RequireVariant({folder.path(), name});
              }),
              (folder.path() / "variants").string() + ": has no folder \"" + name +
                  "\", expected one of low, tall");
  }
}

TEST(ListPhotographs, OfARawAndItsJpegTakesTheJpeg) {
  const ScratchFolder folder;
  const auto raw = folder.Write("photos/b.dng", ""), alone = folder.Write("photos/a.cr2", "");
  const auto jpeg = folder.Write("photos/b.jpg", "");
  EXPECT_EQ(ListPhotographs({folder.path()}), (std::vector{alone, jpeg}));
}

TEST(ListPhotographs, TwoOfOneNameAreRefused) {
  const ScratchFolder folder;
  for (const auto& [first, second] : {std::pair("a.jpg", "a.png"), std::pair("b.dng", "b.nef")}) {
    const auto one = folder.Write(std::string("photos/") + first, "");
    const auto other = folder.Write(std::string("photos/") + second, "");
    EXPECT_EQ(InputErrorOf([&] { ListPhotographs({folder.path()}); }),
              other.string() + ": has the same name as " + first +
                  ", expected each photograph's name once");
    std::filesystem::remove(one);
    std::filesystem::remove(other);
  }
}

}  // namespace
}  // namespace insitu
