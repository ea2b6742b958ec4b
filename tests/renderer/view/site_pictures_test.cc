// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/site_pictures.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;

class SitePicturesTest : public testing::Test {
 protected:
  SitePicturesTest() {
    for (Raster* raster : {&photo_, &montage_}) raster->data.assign(raster->data.size(), 0.25f);
    montage_.SetRgb(7, 5, {0.25, 0.5, 0.25});
    montage_.At(8, 5)[0] = std::nextafter(0.25f, 1.f);  // by less than any code
    WriteExr(site_.photos() / "a.b.exr", photo_);
    WriteExr(site_.montages() / "a.b.exr", montage_);
  }
  Json::Value PictureOf(const std::string& kind, const std::string& name) {
    const Json::Value photos = pictures().List();
    for (const Json::Value& picture : photos[0]["pictures"]) {
      if (picture["kind"] == kind && picture["name"] == name) return picture;
    }
    return {};
  }
  SitePictures& pictures() {
    if (!pictures_) pictures_ = std::make_unique<SitePictures>(site_, renders_);
    return *pictures_;
  }

  ScratchFolder folder_;
  SitePaths site_{folder_.path()};
  Raster photo_{40, 30}, montage_{40, 30};
  RunningRenders renders_{site_};
  std::unique_ptr<SitePictures> pictures_;
};

TEST_F(SitePicturesTest, ListsVariantsHoursAndLayersButNothingElse) {
  WriteExr(site_.montages() / "a.b@0915.exr", montage_);
  WriteExr(site_.montages() / "tall/a.b.exr", montage_);
  WriteExr(site_.montages() / "tall/a.b@1830.exr", montage_);
  WriteExr(site_.montages() / "a.b.layers.exr", montage_);
  WriteExr(site_.montages() / "a.b@0915.shadows.exr", montage_);
  WriteExr(site_.montages() / "tall/a.b~fast.exr", montage_);
  WriteExr(site_.montages() / "a.bc.exr", montage_);
  std::vector<std::string> names;
  const Json::Value photos = pictures().List();
  for (const Json::Value& picture : photos[0]["pictures"]) {
    names.push_back(picture["kind"].asString() + ":" + picture["name"].asString());
  }
  EXPECT_THAT(names,
              testing::ElementsAre("photo:", "montage:", "montage:@0915", "montage:tall",
                                   "montage:tall@1830", "montage:tall~fast", "layer:photograph",
                                   "layer:computed", "layer:front", "layer:sunlit"));
  EXPECT_EQ(PictureOf("layer", "front")["of"], "");
  EXPECT_EQ(PictureOf("layer", "sunlit")["of"], "@0915");
  const Json::Value share =
      pictures().Of(PictureOf("layer", "computed")["id"].asInt())->Value(7, 5);
  EXPECT_EQ(share["share"].asDouble(), 0.5);
}

// As insitu-render's --layers writes them: of one part each.
void WriteParts(const std::filesystem::path& file, const std::vector<OIIO::ImageSpec>& specs,
                const std::vector<float>& samples) {
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out->open(file.string(), static_cast<int>(specs.size()), specs.data()));
  for (size_t i = 0; i < specs.size(); ++i) {
    if (i > 0) {
      ASSERT_TRUE(out->open(file.string(), specs[i], OIIO::ImageOutput::AppendSubimage));
    }
    ASSERT_TRUE(out->write_image(OIIO::TypeFloat, samples.data()));
  }
  ASSERT_TRUE(out->close());
}

OIIO::ImageSpec PartSpec(const std::string& name, const std::vector<std::string>& channels) {
  OIIO::ImageSpec spec(40, 30, static_cast<int>(channels.size()), OIIO::TypeFloat);
  spec.channelnames = channels;
  spec.attribute("oiio:subimagename", name);
  spec.attribute("cryptomatte/1234567/manifest", R"({"wall": "3e800000"})");
  return spec;
}

TEST_F(SitePicturesTest, PartsAreShownOneByOne) {
  const std::string matte = "CryptoObject00";
  std::vector<float> samples(4800, -0.25F);         // of four channels
  for (size_t i = 0; i < samples.size(); i += 4) {  // all of a wall, a quarter
    samples[i] = samples[i + 1] = 0.25F;
    samples[i + 2] = samples[i + 3] = 0;
  }
  WriteParts(site_.montages() / "a.b.parts.exr",
             {PartSpec("sun_blocked", {"sun_blocked.R", "sun_blocked.G", "sun_blocked.B"}),
              PartSpec(matte, {matte + ".R", matte + ".G", matte + ".B", matte + ".A"}),
              PartSpec("CryptoObject01", {"CryptoObject01.R"}), PartSpec("depth", {"depth.Z"})},
             samples);
  EXPECT_TRUE(PictureOf("part", "CryptoObject01").isNull());
  const auto value_of = [&](const std::string& part) {
    return pictures().Of(PictureOf("part", part)["id"].asInt())->Value(0, 0);
  };
  EXPECT_EQ(value_of("sun_blocked")["linear"][0].asDouble(), 0.25);
  EXPECT_EQ(value_of("depth")["values"][0].asDouble(), 0.25);
  const Json::Value things = value_of(matte)["things"];
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things[0]["name"], "wall");
  EXPECT_EQ(things[0]["share"].asDouble(), 0.25);
}

TEST_F(SitePicturesTest, APartThatCannotBeReadSaysSo) {
  WriteWhole(site_.montages() / "a.b.parts.exr", "no EXR");
  EXPECT_TRUE(PictureOf("part", "depth").isNull());
  EXPECT_EQ(PictureOf("montage", "")["fault"], Json::Value());
}

TEST_F(SitePicturesTest, ADifferenceIsBlackOnlyWhereAllBitsAreTheSame) {
  const int photo = PictureOf("photo", "")["id"].asInt();
  const int montage = PictureOf("montage", "")["id"].asInt();
  const Json::Value difference = pictures().Difference(photo, montage);
  EXPECT_EQ(difference["summary"]["differing"].asInt(), 2);
  const double codes = 255 * (SrgbFromLinear(0.5) - SrgbFromLinear(0.25));
  EXPECT_NEAR(difference["summary"]["most"].asDouble(), codes, 1e-6);
  const auto shown = pictures().Of(difference["id"].asInt());
  EXPECT_NEAR(shown->Value(7, 5)["codes"][1].asDouble(), codes, 1e-6);
  EXPECT_EQ(shown->Value(6, 5)["encoded"][1].asDouble(), 0);
  EXPECT_GT(shown->Value(8, 5)["encoded"][1].asDouble(), 0.05);
  WriteExr(site_.montages() / "a.b.exr", photo_);
  EXPECT_EQ(pictures().Difference(photo, montage)["summary"]["differing"].asInt(), 0);
  WriteExr(site_.montages() / "small/a.b.exr", Raster(20, 15));
  const int other = PictureOf("montage", "small")["id"].asInt();
  EXPECT_THROW(pictures().Difference(photo, other), InputError);
  EXPECT_THROW(pictures().Difference(photo, 99), InputError);
}

TEST_F(SitePicturesTest, TheFrameIsTheOneThatWasRendered) {
  EXPECT_EQ(PictureOf("montage", "")["frame"].asString(), "photo");
  Json::Value record;
  record["frame"] = "pinhole";
  WriteJson(site_.root / "work/render/a.b.json", record);
  WriteExr(site_.input_image("a.b"), photo_);
  EXPECT_EQ(PictureOf("montage", "")["frame"].asString(), "pinhole");
  EXPECT_EQ(PictureOf("input", "")["frame"].asString(), "pinhole");
  EXPECT_EQ(PictureOf("photo", "")["frame"].asString(), "photo");
}

TEST_F(SitePicturesTest, WhatCannotBeReadIsToldAndTheRestShown) {
  WriteWhole(site_.montages() / "a.b.exr", std::string("no picture"));
  EXPECT_THAT(PictureOf("montage", "")["fault"].asString(), HasSubstr("a.b.exr"));
  EXPECT_EQ(PictureOf("photo", "")["width"].asInt(), 40);
}

TEST_F(SitePicturesTest, ItsVersionTellsThatAMontageIsAnotherOne) {
  const std::string before = pictures().Version();
  EXPECT_EQ(pictures().Version(), before);
  WriteExr(site_.montages() / "tall/a.b.exr", montage_);
  EXPECT_NE(pictures().Version(), before);
}

}  // namespace
}  // namespace insitu
