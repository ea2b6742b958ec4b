// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/materials/material_proposals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/json_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Proposals : public testing::Test {
 protected:
  Proposals() {
    Add("aluminium", "material", R"("alu", "aluminum")");
    Add("brick_red", "material", R"("backstein", "ziegel")");
    Add("timber_larch", "material", R"("lärche", "holz")");
    Add("led", "lamp", R"("brick_red")");
    library_ = MaterialLibrary({folder_.path() / "library"});
  }
  void Add(const std::string& name, const std::string& kind, const std::string& words) {
    folder_.Write("library/" + name + ".json",
                  "{\"kind\": \"" + kind +
                      "\", \"source\": \"us\", \"licence\": \"-\", \"words\": [" + words +
                      R"(], "spectrum_table": [[400, 1], [700, 1]]})");
  }
  ScratchFolder folder_;
  MaterialLibrary library_;
};

TEST_F(Proposals, ByWordsInAnyLanguage) {
  EXPECT_THAT(ProposalsFor("Backstein rot", library_), ElementsAre("brick_red"));
  EXPECT_THAT(ProposalsFor("Wand-Backsteinmauerwerk", library_), ElementsAre("brick_red"));
  EXPECT_THAT(ProposalsFor("ALU", library_), ElementsAre("aluminium"));
  EXPECT_THAT(ProposalsFor("A_Fassade_ALU_01", library_), ElementsAre("aluminium"));
  EXPECT_THAT(ProposalsFor("Lärchenholz", library_), ElementsAre("timber_larch"));
  EXPECT_THAT(ProposalsFor("LAERCHE", library_), ElementsAre("timber_larch"));
  EXPECT_THAT(ProposalsFor("Evaluation", library_), IsEmpty());  // a short word stands alone
  EXPECT_THAT(ProposalsFor("0", library_), IsEmpty());
  EXPECT_THAT(ProposalsFor("Holz, Alu", library_), ElementsAre("timber_larch", "aluminium"));
}

TEST_F(Proposals, OfAModelAreNotTaken) {
  folder_.Write("house.mtl", "newmtl Alu\nKd 0.1 0.2 0.3\n");
  const auto model = folder_.Write("house.obj",
                                   "mtllib house.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng Dach\n"
                                   "usemtl Alu\nf 1 2 3\n");
  const auto text = folder_.Write("materials.json", ProposedMaterials({model}, library_));
  const JsonNode materials = JsonNode::Load(text).At("materials");
  EXPECT_EQ(materials.At("Alu").At("proposed").Text(), "aluminium");
  EXPECT_FALSE(materials.At("Alu").Find("use"));
  EXPECT_TRUE(materials.At("Alu").Find("diffuse_rgb"));
  EXPECT_FALSE(JsonNode::Load(text).At("layers").At("Dach").Find("proposed"));
}

}  // namespace
}  // namespace insitu
