// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/objects_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "renderer/formats/model_file.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::IsEmpty;

const char kPyramid[] = R"({"name": "plinth", "polyhedron": {
 "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]],
 "faces": [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]}})";

class ObjectsModel : public testing::Test {
 protected:
  Model Read(const std::string& objects) {
    return ReadModel(folder_.Write("objects.json", "{\"objects\": [\n" + objects + "]}"));
  }
  std::string Complaint(const std::string& objects) {
    try {
      Read(objects);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

TEST_F(ObjectsModel, ReadsThePapersThreeKinds) {
  const Model model = Read(std::string(kPyramid) +
                           R"(, {"name": "b", "layer": "balls", "material": "glass", "opacity": 0.1,
    "sphere": {"center": [1, 2, 3], "radius_m": 0.25}},
   {"name": "p", "polygon": {"vertices": [[0, 0, 5], [3, 0, 5], [0, 3, 5]]}})");
  EXPECT_NEAR(VolumeOf(model.mesh), 1.0 / 3 + 4.5 * 5 / 3, 1e-12);
  ASSERT_EQ(model.mesh.spheres.size(), 1u);
  EXPECT_EQ(model.mesh.spheres[0].center, Vector3d(1, 2, 3));
  const SurfaceNames& ball = model.mesh.surfaces[model.mesh.spheres[0].surface];
  EXPECT_EQ(ball.layer, "balls");
  EXPECT_EQ(ball.material, "glass");
  EXPECT_TRUE(ball.is_solid);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "plinth");
  EXPECT_EQ(model.entities.at("polyhedron"), 1);
  EXPECT_EQ(model.metres_per_unit, 1);
  EXPECT_THAT(model.warnings, IsEmpty());
}

TEST_F(ObjectsModel, TellsFaultsByLine) {
  EXPECT_THAT(Complaint(R"({"name": "b", "sphere": {"center": [1, 2, 3], "radius_m": 0}})"),
              HasSubstr("objects.json:2: "));
  EXPECT_THAT(Complaint(R"({"name": "b", "spere": {}})"), HasSubstr("is no key"));
  EXPECT_THAT(Complaint(R"({"name": "b"})"), HasSubstr("not one of the three"));
  EXPECT_THAT(Complaint(std::string(kPyramid) + "," + kPyramid), HasSubstr("two objects"));
  EXPECT_THAT(Complaint(R"({"name": "p", "polygon": {"vertices":
   [[0, 0, 0], [1, 0, 0], [1, 1, 0.1], [0, 1, 0]]}})"),
              HasSubstr("not planar"));
  EXPECT_THAT(Complaint(R"({"name": "p", "polygon": {"vertices":
   [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "holes": [[[5, 5, 0], [6, 5, 0], [6, 6, 0]]]}})"),
              HasSubstr("hole"));
  EXPECT_THAT(Complaint(R"({"name": "p", "polyhedron": {"vertices":
   [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 3]]}})"),
              HasSubstr("is no vertex, expected 0 to 2"));
}

TEST_F(ObjectsModel, AnotherFormatOrVersionIsRefused) {
  const auto complaint = [&](const std::string& stated) {
    const auto path = folder_.Write("objects.json", "{" + stated + R"(, "objects": []})");
    return InputErrorOf([&] { ReadModel(path); });
  };
  EXPECT_THAT(complaint(R"("format": "insitu building")"), HasSubstr("is another format"));
  EXPECT_THAT(complaint(R"("version": 2)"), HasSubstr("expected 1"));
  EXPECT_NO_THROW(ReadModel(folder_.Write("objects.json", R"({"version": 1, "objects": []})")));
}

TEST_F(ObjectsModel, SaysWhatIsOpen) {
  std::string open = kPyramid;
  const std::string bottom = "[3, 2, 1, 0], ";
  open.erase(open.find(bottom), bottom.size());
  EXPECT_THAT(Read(open).warnings, testing::ElementsAre(HasSubstr("\"plinth\" has 4 edges")));
}

TEST_F(ObjectsModel, AnotherNameNamesItsFormat) {
  const std::string text = R"({"format": "insitu objects", "objects": []})";
  EXPECT_EQ(ReadModel(folder_.Write("balls.json", text)).format, "insitu objects");
}

}  // namespace
}  // namespace insitu
