// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/isolated.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

#include "tests/calibration/files/wrong_field.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

TEST(Isolated, ACrashOrAnEndlessLoopThereIsAFailureHere) {
  const auto crash = [] {
    std::raise(SIGSEGV);
    return Model{};
  };
  EXPECT_THAT(ReadIsolated(crash).failure, HasSubstr("breaks its reader"));
  const auto loop = [] {
    volatile bool on = true;
    while (on) continue;
    return Model{};
  };
  EXPECT_THAT(ReadIsolated(loop, {.seconds = 1}).failure, HasSubstr("longer than 1 s"));
  const auto refuse = []() -> Model { throw std::runtime_error("no"); };
  EXPECT_EQ(ReadIsolated(refuse).failure, "no");
}

TEST(Isolated, BringsTheWholeModel) {
  Model model;
  model.mesh.surfaces = {{.layer = "a",
                          .block = "b",
                          .material = "c",
                          .rgb = Vector3d(1, 0.5, 0),
                          .opacity = 0.3,
                          .texture = "t.png",
                          .texture_place = "m:1",
                          .maps = {{.kind = SurfaceMap::Kind::kNormal, .file = "n.png"}},
                          .is_solid = true,
                          .index = 1.33,
                          .absorption_rgb = Vector3d(1, 2, 3),
                          .diffuse_weight = 0.5,
                          .translucent_rgb = Vector3d(0.1, 0.2, 0.3)},
                         {}};
  model.mesh.vertices = {{1, 2, 3}, {4, 5, 6}, {7, 8, 1e9 / 3}};
  model.mesh.triangles = {{0, 1, 2}};
  model.mesh.surface_of_triangle = {1};
  model.mesh.corner_uvs = {{0, 1}, {1, 1}, {1, 0}};
  model.entities = {{"mesh", 2}};
  model.images = {{"*0", std::string("\x89PNG\0", 5)}};
  model.skipped = {{{"line", "no surface"}, 3}};
  model.warnings = {"careful"};
  model.lamps = {{"spot", {1, 2, 3}, {0, 1, 0}, {1, 0.5, 0}, 800, 10.0, 45.0}};
  model.metres_per_unit = 0.5;
  const auto read = ReadIsolated([&] { return model; }).model;
  ASSERT_TRUE(read);
  EXPECT_EQ(read->mesh.surfaces, model.mesh.surfaces);
  EXPECT_EQ(read->mesh.vertices, model.mesh.vertices);
  EXPECT_EQ(read->mesh.triangles, model.mesh.triangles);
  EXPECT_EQ(read->mesh.corner_uvs, model.mesh.corner_uvs);
  EXPECT_EQ(read->entities, model.entities);
  EXPECT_EQ(read->images, model.images);
  EXPECT_EQ(read->skipped, model.skipped);
  EXPECT_EQ(read->warnings, model.warnings);
  EXPECT_EQ(read->metres_per_unit, 0.5);
  ASSERT_EQ(read->lamps.size(), 1u);
  EXPECT_EQ(read->lamps[0].name, "spot");
  EXPECT_EQ(read->lamps[0].position, Vector3d(1, 2, 3));
  EXPECT_EQ(read->lamps[0].candela, 800);
  EXPECT_EQ(read->lamps[0].outer_deg, 45.0);
}

TEST(Isolated, LimitsNameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(IsolationLimits()), "");
  EXPECT_THAT(WrongField(IsolationLimits{.seconds = 0}), HasSubstr("seconds"));
  EXPECT_THAT(WrongField(IsolationLimits{.bytes = 0}), HasSubstr("bytes"));
}

}  // namespace
}  // namespace insitu
