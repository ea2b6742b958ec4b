// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/material.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

SitePaths SiteWithMaterials(const std::string& materials) {
  const SitePaths site{std::filesystem::path(testing::TempDir()) / "insitu_radiometry" /
                       "materials"};
  std::filesystem::remove_all(site.root);
  if (!materials.empty()) WriteWhole(site.survey() / "materials.json", materials);
  return site;
}

std::string ErrorOf(const std::string& materials) {
  try {
    ReadNaturalMaterials(SiteWithMaterials(materials));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReadNaturalMaterials, ReadsAllKinds) {
  const auto materials = ReadNaturalMaterials(SiteWithMaterials(R"({"materials": {
    "lawn": {"specular": "none", "specular_weight": 0.0, "ior": null, "roughness": null,
             "diffuse": "from photo"},
    "water": {"specular": "fresnel", "specular_weight": 0.9, "ior": 1.33, "roughness": 0.05,
              "distribution": "beckmann"},
    "pool": {"use": "water", "roughness": 0.1, "transmission": 0.7},
    "steel": {"specular": "mirror", "specular_weight": 0.6, "diffuse_weight": 0.5}}})"));
  ASSERT_EQ(materials.size(), 4u);
  EXPECT_NEAR(*materials.at("pool").specular->index, 1.333, 2e-3);  // of the library
  EXPECT_EQ(materials.at("pool").specular->roughness.slope, 0.1);
  EXPECT_EQ(materials.at("pool").transmission, 0.7);
  EXPECT_EQ(materials.at("lawn").transmission, 0);
  EXPECT_FALSE(materials.at("lawn").specular);
  EXPECT_EQ(materials.at("lawn").diffuse_weight, 1);
  EXPECT_EQ(materials.at("water").specular->weight, 0.9);
  EXPECT_EQ(materials.at("water").specular->index, 1.33);
  EXPECT_EQ(materials.at("water").specular->roughness,
            (Roughness{0.05, FacetDistribution::kBeckmann}));
  EXPECT_FALSE(materials.at("steel").specular->index);
  EXPECT_EQ(materials.at("steel").specular->roughness, Roughness{});
  EXPECT_EQ(materials.at("steel").diffuse_weight, 0.5);
}

TEST(ReadNaturalMaterials, MayBeMissing) {
  EXPECT_TRUE(ReadNaturalMaterials(SiteWithMaterials("")).empty());
}

TEST(ReadNaturalMaterials, FaultsNameFileAndLine) {
  const auto expect = [](const std::string& body, int line, const std::string& message) {
    const std::string error = ErrorOf("{\"materials\": {\n\"a\": {\n" + body + "\n}}}\n");
    EXPECT_NE(error.find("materials.json:" + std::to_string(line) + ":"), std::string::npos)
        << error;
    EXPECT_NE(error.find(message), std::string::npos) << error;
  };
  expect("\"transmission\": 1.2", 3, "expected 0 to 1");
  expect("\"specular\": \"shiny\"", 3, "expected \"none\", \"fresnel\" or \"mirror\"");
  expect("\"specular\": \"mirror\",\n\"specular_weight\": 1.5", 4, "expected 0 to 1");
  expect("\"specular\": \"mirror\",\n\n\"roughness\": 1.2", 5, "expected 0 to 1");
  expect("\"specular\": \"mirror\",\n\"distribution\": \"phong\"", 4, "\"ggx\" or \"beckmann\"");
  expect("\"specular\": \"fresnel\"", 2, "\"ior\" is missing");
  expect("\"specular\": \"fresnel\",\n\"ior\": 0.9", 4, "expected above 1");
  expect("\"bumps\": {\"rms_slope\": 0.1, \"scale_m\": 1}", 3, "mirrors nothing");
  expect("\"diffuse_weight\": 0", 3, "expected above 0");
  expect("\"diffuse\": \"grey\"", 3, "expected \"from photo\"");
}

}  // namespace
}  // namespace insitu
