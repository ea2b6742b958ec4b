// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/dbat_camera.h"

#include "calibration/camera_files/read_camera_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

const std::string kCamera =
    "<?xml version=\"1.0\"?>\n<document dbat_camera_version=\"1.0\"><cameras><camera>\n"
    "<id>1</id><sensor>auto,5.4</sensor><image>2272,1704</image><aspect>1</aspect>\n"
    "<focal>7.4</focal><model>3</model><cc>7.5</cc><pp>3.6,2.7</pp><skew>0</skew>\n"
    "<K>0.004,-4e-5</K><P>-6e-5,-4e-5</P>\n</camera></cameras></document>\n";

std::string With(const std::string& from, const std::string& to) {
  std::string text = kCamera;
  return text.replace(text.find(from), from.size(), to);
}

class DbatCameras : public testing::Test {
 protected:
  // The camera as a script of DBAT has it.
  DbatCamera InScript(const std::string& text) {
    return ParseDbatCamera(
        XmlNode::Load(folder_.Write("camera.xml", text)).At("cameras").At("camera"));
  }
  // The same as a camera file.
  MetricCamera InFile(const std::string& text) {
    return *ReadCameraFile(folder_.Write("camera.xml", text)).metric;
  }
  ScratchFolder folder_;
};

// Scripts and camera files were read in two places once.
TEST_F(DbatCameras, AreTheSameInAScriptAndInACameraFile) {
  for (const std::string& text :
       {kCamera, With("auto,5.4", "7.2,5.4"), With("<model>3", "<model>1"),
        With("<K>0.004,-4e-5</K>", "<K>0.004</K>")}) {
    const MetricCamera script = MetricFromDbat(InScript(text)), file = InFile(text);
    EXPECT_EQ(script.parameters, file.parameters);
    EXPECT_EQ(script.pixel_mm, file.pixel_mm);
    EXPECT_EQ(script.origin_px, Eigen::Vector2d(-0.5, -0.5));
    EXPECT_EQ(file.origin_px, script.origin_px);
    EXPECT_EQ(file.width, 2272);
    EXPECT_EQ(script.parameters[0], 7.5);
    EXPECT_EQ(script.parameters[2], -2.7);
  }
}

TEST_F(DbatCameras, HaveTheirOwnPixelsByEachAxis) {
  const MetricCamera camera = MetricFromDbat(InScript(With("auto,5.4", "8,5.4")));
  EXPECT_NEAR(camera.pixel_mm.x(), 8.0 / 2272, 1e-15);
  EXPECT_NEAR(camera.pixel_mm.y(), 5.4 / 1704, 1e-15);
  EXPECT_EQ(camera.parameters[8], 0);
  const std::string without = With("auto,5.4", "8,5.4");
  std::string text = without;
  text.erase(text.find("<aspect>1</aspect>"), 18);
  EXPECT_EQ(MetricFromDbat(InScript(text)).pixel_mm, camera.pixel_mm);
}

// As DBAT wrote it of an Olympus C4040Z: 7.2501867 mm, stretched by 2 - aspect.
TEST_F(DbatCameras, WidthIsReadWithoutTheStretchOfTheAspect) {
  std::string text = With("auto,5.4", "7.25301132255482273,5.43764000000000003");
  text.replace(text.find("<aspect>1"), 9, "<aspect>0.999610402322309577");
  const MetricCamera camera = MetricFromDbat(InScript(text));
  EXPECT_NEAR(camera.pixel_mm.x(), camera.pixel_mm.y(), 1e-12);
  EXPECT_NEAR(camera.parameters[8], 3.89597677690423e-4, 1e-12);
}

TEST_F(DbatCameras, MayLeaveOutTheNominalFocalLength) {
  EXPECT_EQ(InScript(With("<focal>7.4</focal>", "")).focal_mm, 7.5);
}

TEST_F(DbatCameras, AScriptMayLeaveValuesToDbat) {
  std::string text = With("<cc>7.5</cc><pp>3.6,2.7</pp>", "");
  const DbatCamera camera = InScript(text);
  EXPECT_EQ(camera.cc_mm, 7.4);
  EXPECT_NEAR((camera.pp_mm - camera.sensor_mm / 2).norm(), 0, 1e-15);
  EXPECT_NE(InputErrorOf([&] { InFile(text); }).find("<cc> is missing"), std::string::npos);
  text.erase(text.find("<focal>7.4</focal>"), 18);
  EXPECT_NE(InputErrorOf([&] { InScript(text); }).find("expected one of them"), std::string::npos);
}

TEST_F(DbatCameras, ReturnFromOurs) {
  DbatCamera camera;
  camera.width = 3600;
  camera.height = 2400;
  camera.sensor_mm = {36.5, 24};
  camera.focal_mm = camera.cc_mm = 30;
  camera.pp_mm = {18.1, 11.9};
  camera.aspect = 0.999;
  camera.K = {1e-4, 2e-7, 3e-10};
  camera.P = {1e-5, -2e-5};
  const DbatCamera again = DbatFromMetric(MetricFromDbat(camera));
  EXPECT_EQ(again.pp_mm, camera.pp_mm);
  EXPECT_NEAR(again.aspect, camera.aspect, 1e-15);
  EXPECT_EQ(again.K, camera.K);
  EXPECT_EQ(again.P, camera.P);
  EXPECT_NEAR((again.sensor_mm - camera.sensor_mm).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace insitu
