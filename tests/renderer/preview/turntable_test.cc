// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/preview/turntable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;

// A square of two triangles far from the origin, with four open edges.
ArtificialEnvironment Square() {
  ArtificialEnvironment building;
  building.materials.resize(1);
  building.vertices = {{2600000, 0, 0}, {2600002, 0, 0}, {2600002, 2, 0}, {2600000, 2, 0}};
  building.triangles = {{0, 1, 2}, {0, 2, 3}};
  building.material_of_triangle = {0, 0};
  return building;
}

class TurntablePage : public testing::Test {
 protected:
  void SetUp() override {
    folder_.Write("three.min.js", "/* three */");
    folder_.Write("OrbitControls.js", "/* controls */");
    setenv("INSITU_THREE", folder_.path().c_str(), 1);
  }
  void TearDown() override { unsetenv("INSITU_THREE"); }
  ScratchFolder folder_;
};

TEST_F(TurntablePage, HoldsAllThatItNeeds) {
  const std::string page = Turntable(Square(), {{"a</script>b"}, {0, 0}});
  EXPECT_THAT(page, HasSubstr("/* three */"));
  EXPECT_THAT(page, HasSubstr("/* controls */"));
  EXPECT_THAT(page, HasSubstr("\"center\":[2600001"));
  EXPECT_THAT(page, HasSubstr("a<\\/script>b"));
  // Edges 0-1, 0-3, 1-2, 2-3 as 32-bit numbers; 0-2 has two triangles.
  EXPECT_THAT(page, HasSubstr("\"open_edges\":\"AAAAAAEAAAAAAAAAAwAAAAEAAAACAAAAAgAAAAMAAAA=\""));
}

// Of one material one part, however many layers: its triangles go layer by layer, in runs.
TEST_F(TurntablePage, TrianglesOfAMaterialAreInRunsOfLayers) {
  ArtificialEnvironment building = Square();
  building.triangles.emplace_back(1, 2, 3);
  building.material_of_triangle = {0, 0, 0};
  const std::string page = Turntable(building, {{"a", "b"}, {1, 0, 1}});
  // 0 2 3, then 0 1 2 and 1 2 3; layer 0 has one triangle, layer 1 two.
  EXPECT_THAT(page,
              HasSubstr("\"triangles\":\"AAAAAAIAAAADAAAAAAAAAAEAAAACAAAAAQAAAAIAAAADAAAA\""));
  EXPECT_THAT(page, HasSubstr("\"runs\":\"AAAAAAEAAAABAAAAAgAAAA==\""));
  EXPECT_EQ(page.find("\"rgb\""), page.rfind("\"rgb\""));
}

// The long side of one triangle, the two halves of others: no gap.
TEST_F(TurntablePage, SidesWithSeveralNeighboursAreNotOpen) {
  ArtificialEnvironment building = Square();
  building.vertices.emplace_back(2600001, 1, 0);
  building.triangles = {{0, 1, 2}, {0, 4, 3}, {4, 2, 3}};
  building.material_of_triangle = {0, 0, 0};
  const std::string page = Turntable(building, {{"a"}, {0, 0, 0}});
  EXPECT_THAT(page, HasSubstr("\"open_edges\":\"AAAAAAEAAAAAAAAAAwAAAAEAAAACAAAAAgAAAAMAAAA=\""));
}

TEST_F(TurntablePage, IsLeftOutWithoutThree) {
  setenv("INSITU_THREE", "/nowhere", 1);
  EXPECT_EQ(Turntable(Square(), {{"a"}, {0, 0}}), "");
}

TEST_F(TurntablePage, IsLeftOutWithoutFaces) {
  EXPECT_EQ(Turntable(ArtificialEnvironment(), {}), "");
  EXPECT_THROW(Turntable(Square(), {{"a"}, {0}}), CheckError);
}

}  // namespace
}  // namespace insitu
