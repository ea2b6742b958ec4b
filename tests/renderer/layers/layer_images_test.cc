// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/layer_images.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <sstream>

#include "calibration/files/error.h"
#include "renderer/layers/cryptomatte.h"
#include "renderer/layers/layer_names.h"
#include "renderer/picture/render.h"
#include "renderer/trace/interreflected_light.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

using Parts = std::map<std::string, std::vector<float>>;

const LightErrors kErrors = {Eigen::Vector3d::Constant(0.05), Eigen::Vector3d::Constant(0.1)};

// Every part of a file by its name.
Parts ReadParts(const std::filesystem::path& file, std::string* sum) {
  Parts parts;
  const auto in = OIIO::ImageInput::open(file.string());
  EXPECT_TRUE(in);
  for (int i = 0; in && in->seek_subimage(i, 0); ++i) {
    const OIIO::ImageSpec spec = in->spec();
    if (i == 0) *sum = spec.get_string_attribute("insituSum");
    std::vector<float>& samples = parts[std::string(spec.get_string_attribute("name"))];
    samples.resize(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
    EXPECT_TRUE(in->read_image(i, 0, 0, spec.nchannels, OIIO::TypeFloat, samples.data()));
  }
  return parts;
}

// A hazy lawn with a box that mirrors a little, lit by a lamp too.
class LayerImagesTest : public testing::Test {
 protected:
  LayerImagesTest() {
    for (size_t i = 0; i < site_.photo.data.size(); ++i) {
      site_.photo.data[i] = 0.1F + static_cast<float>((i * 7919) % 1000) / 2000;
    }
    site_.natural.air.transmittance = Spectrum::Constant(0.995) * site_.natural.spectra.Ones() +
                                      (1 - site_.natural.spectra.Ones());
    SurfaceMaterial material{.name = "coated", .diffuse_rgb = {0.6, 0.3, 0.2}};
    material.specular = Specular{.weight = 1, .index = 1.5};
    building_ = Box(site_, {-1, 3, 0}, {1, 5, 3}, material);
    building_.lights.push_back(
        {"lamp", site_.natural.scene.origin + Eigen::Vector3d(2, 0, 2), {0.4, 0.3, 0.2}});
  }

  // Renders, writes all, and reads it back.
  Parts Render(bool is_interreflected, const RenderOptions& more = {},
               const std::string& chosen = "all") {
    MontageScene scene = site_.With(building_);
    if (is_interreflected) AddInterreflection(&scene, 1, nullptr, 4);
    LayerImages layers(site_.photo, nullptr, ThingsOf(scene, building_, kErrors),
                       ChosenLayers(chosen));
    RenderOptions options = more;
    plain_ = RenderMontage(scene, site_.camera(), site_.photo, options).linear;
    options.layers = [&](int x, int y, const LayeredPixel& pixel) { layers.Take(x, y, pixel); };
    montage_ = RenderMontage(scene, site_.camera(), site_.photo, options).linear;
    const auto file = scratch_.path() / "a.parts.exr";
    layers.Write(file, montage_, Eigen::Vector3d::Ones(), 1);
    return ReadParts(file, &sum_);
  }

  // As the header says it.
  std::vector<float> Summed(const Parts& parts) const {
    std::istringstream words(sum_.substr(sum_.find('=') + 1));
    std::vector<float> sum;
    for (std::string word; words >> word;) {
      if (word == "+") continue;
      const std::vector<float>& part = parts.at(word);
      if (sum.empty()) {
        sum = part;
        continue;
      }
      for (size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
    }
    return sum;
  }

  static double Largest(const std::vector<float>& samples) {
    double largest = 0;
    for (const float value : samples) largest = std::max<double>(largest, std::abs(value));
    return largest;
  }

  SmallSite site_ = MakeSmallSite();
  ArtificialEnvironment building_;
  ScratchFolder scratch_;
  Raster plain_, montage_;
  std::string sum_;
};

TEST_F(LayerImagesTest, AddUpToTheMontageBitForBit) {
  RenderOptions spread;
  spread.point_spread = PointSpread{0.7, 0.7, 0, 9};
  spread.grain = Grain{};
  for (const RenderOptions& options : {RenderOptions(), spread}) {
    for (const bool is_interreflected : {false, true}) {
      const Parts parts = Render(is_interreflected, options);
      EXPECT_EQ(parts.at("montage"), montage_.data);
      const std::vector<float> sum = Summed(parts);
      for (size_t i = 0; i < sum.size(); ++i) ASSERT_EQ(sum[i], montage_.data[i]) << i;
    }
  }
}

TEST_F(LayerImagesTest, AskingForThemChangesNothing) {
  Render(true);
  EXPECT_EQ(plain_.data, montage_.data);
}

// Where no bound was reached the parts themselves are the sum; the rest is rounding.
TEST_F(LayerImagesTest, TheRestIsRounding) {
  const Parts parts = Render(true);
  EXPECT_LT(Largest(parts.at("rest")), 1e-6);
  EXPECT_EQ(Largest(parts.at("rest_fine")), 0);
  for (const char* part : {"building_sun", "building_sky", "building_surroundings",
                           "building_lamps", "building_reflection", "building_haze", "sun_blocked",
                           "sky_blocked", "bounced_light", "change_lamps"}) {
    EXPECT_GT(Largest(parts.at(part)), 1e-4) << part;
  }
  for (const char* part : {"sun_blocked", "sky_blocked", "surroundings_blocked"}) {
    for (const float value : parts.at(part)) ASSERT_LE(value, 0) << part;
  }
  EXPECT_EQ(Largest(parts.at("building_transmission")), 0);
}

TEST_F(LayerImagesTest, GlassMirrorsAndLetsThrough) {
  building_.materials[0].glass = Glass{.weight = 0.8, .thickness = 0.01};
  const Parts parts = Render(true);
  EXPECT_LT(Largest(parts.at("rest")), 1e-6);
  EXPECT_GT(Largest(parts.at("building_transmission")), 0.05);
  EXPECT_GT(Largest(parts.at("building_reflection")), 1e-3);
}

// A render that was stopped goes on with what it has kept of its layers.
TEST_F(LayerImagesTest, GoOnWhereTheyWereStopped) {
  const Parts parts = Render(true);
  MontageScene scene = site_.With(building_);
  AddInterreflection(&scene, 1, nullptr, 4);
  const LayerThings things = ThingsOf(scene, building_, kErrors);
  LayerImages before(site_.photo, nullptr, things, LayerNames());
  LayerImages after(site_.photo, nullptr, things, LayerNames());
  LayerImages others(site_.photo, nullptr, things, {"coverage"});
  RenderOptions options;
  options.threads = 1;
  options.layers = [&](int x, int y, const LayeredPixel& pixel) { before.Take(x, y, pixel); };
  RenderCourse course;
  std::vector<FinishedTile> kept;
  course.tile_done = [&](const FinishedTile& tile) {
    kept.push_back(tile);
    kept.back().layers = before.TileBytes(tile.index);
  };
  course.stops = [&] { return kept.size() == 2; };
  RenderMontage(scene, site_.camera(), site_.photo, options, course);
  for (const FinishedTile& tile : kept) {
    EXPECT_FALSE(others.TakeTile(tile.index, tile.layers));
    EXPECT_FALSE(after.TakeTile(tile.index, ""));
    EXPECT_FALSE(after.TakeTile(tile.index, tile.layers + "x"));
    EXPECT_TRUE(after.TakeTile(tile.index, tile.layers));
  }
  options.layers = [&](int x, int y, const LayeredPixel& pixel) { after.Take(x, y, pixel); };
  const RenderResult result =
      RenderMontage(scene, site_.camera(), site_.photo, options, {.earlier = kept});
  const auto file = scratch_.path() / "b.parts.exr";
  after.Write(file, result.linear, Eigen::Vector3d::Ones(), 1);
  EXPECT_EQ(ReadParts(file, &sum_), parts);
}

// What is not chosen goes into the rest.
TEST_F(LayerImagesTest, AChoiceAddsUpToo) {
  const Parts parts = Render(true, {}, "building_sun,sky_blocked");
  EXPECT_EQ(parts.size(), 4U);
  EXPECT_EQ(sum_, "montage = building_sun + sky_blocked + rest + rest_fine");
  const std::vector<float> sum = Summed(parts);
  for (size_t i = 0; i < sum.size(); ++i) ASSERT_EQ(sum[i], montage_.data[i]) << i;
}

TEST_F(LayerImagesTest, UncertaintyIsThatOfTheLight) {
  const Parts parts = Render(true);
  const auto at = [&](const char* name, size_t i) { return parts.at(name)[i]; };
  double largest = 0;
  for (size_t i = 0; i < montage_.data.size(); ++i) {
    const double sun = kErrors.sun[0] * (at("building_sun", i) + at("sun_blocked", i));
    const double sky = kErrors.sky[0] * (at("building_sky", i) + at("sky_blocked", i));
    ASSERT_GE(at("uncertainty", i), std::hypot(sun, sky) - 1e-6);  // and the rays' own
    largest = std::max(largest, std::hypot(sun, sky));
  }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(Largest(parts.at("uncertainty")), 0.1);
}

TEST_F(LayerImagesTest, ALightThatIsNotThereHasAnEmptyLayer) {
  building_.lights.clear();
  site_.natural.light.sun_radiance.setZero();
  const Parts parts = Render(true);
  for (const char* part : {"building_sun", "building_lamps", "sun_blocked", "change_lamps"}) {
    EXPECT_EQ(Largest(parts.at(part)), 0) << part;
  }
}

TEST_F(LayerImagesTest, ThingsAreTheRaysOwn) {
  const Parts parts = Render(false);
  const std::vector<float>& coverage = parts.at("coverage");
  const std::vector<float>& object = parts.at("CryptoObject00");
  const std::vector<float>& depth = parts.at("depth");
  long building = 0;
  for (size_t i = 0; i < coverage.size(); ++i) {
    const float shares = object[4 * i + 1] + object[4 * i + 3];
    ASSERT_LE(shares, 1.0F + 1e-6F);
    if (coverage[i] < 1) continue;
    ++building;
    EXPECT_EQ(object[4 * i], CryptomatteId("building"));
    EXPECT_EQ(parts.at("CryptoMaterial00")[4 * i], CryptomatteId("coated"));
    EXPECT_NEAR(depth[i], 13, 2.5);
    EXPECT_NEAR(std::hypot(parts.at("normal")[3 * i], parts.at("normal")[3 * i + 1],
                           parts.at("normal")[3 * i + 2]),
                1, 1e-5);
  }
  EXPECT_GT(building, 50);
}

TEST(ChosenLayers, NamesThoseThereAre) {
  EXPECT_EQ(ChosenLayers("all"), LayerNames());
  EXPECT_THAT(ChosenLayers("depth,photo"),
              testing::ElementsAre("photo", "rest", "rest_fine", "depth"));
  const std::string fault = InputErrorOf([] { ChosenLayers("photo,depht"); });
  EXPECT_THAT(fault,
              testing::HasSubstr("there is no layer \"depht\", expected all, montage, photo"));
  EXPECT_THROW(ChosenLayers(""), InputError);
}

}  // namespace
}  // namespace insitu
