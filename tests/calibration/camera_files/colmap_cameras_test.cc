// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/colmap_cameras.h"

#include "calibration/camera_files/read_camera_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

const std::string kHead =
    "# Camera list with one line of data per camera:\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, "
    "PARAMS[]\n# Number of cameras: 2\n";
const std::string kFirst = "1 OPENCV 1000 800 900 910 500 400 0.1 -0.02 1e-3 -2e-3\n";
const std::string kSecond = "7 PINHOLE 640 480 500 500 320 240\n";

class ColmapCameras : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& text) {
    return folder_.Write("cameras.txt", text);
  }
  std::string ErrorOf(const std::string& text) {
    const auto path = Write(text);
    return InputErrorOf([&] { ReadColmapCameras(path); }).substr(path.string().size());
  }
  ScratchFolder folder_;
};

// Models and camera files were read in two places once.
TEST_F(ColmapCameras, AreTheSameInAModelAndAsACameraFile) {
  const auto path = Write(kHead + kFirst + kSecond);
  const auto cameras = ReadColmapCameras(path);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras.at(1).lens,
            (ColmapLens{"OPENCV", 1000, 800, {900, 910, 500, 400, 0.1, -0.02, 1e-3, -2e-3}}));
  EXPECT_EQ(cameras.at(7).place.line, 5);
  for (const auto& [id, camera] : cameras) {
    const Camera in_file = ReadCameraFile(path, {std::nullopt, std::to_string(id)}).camera;
    EXPECT_EQ(in_file.intrinsics(), CameraFromColmap(camera.lens)->intrinsics());
  }
}

TEST_F(ColmapCameras, FaultsAreNamedWithTheirLine) {
  EXPECT_EQ(ErrorOf(kHead + kFirst), ": ends after 1 entries, expected 2 as its head says");
  EXPECT_EQ(ErrorOf(kFirst + kFirst), ":2: camera 1 occurs twice");
  EXPECT_EQ(ErrorOf("1 OPENGL 1 1 1 1 1 1"), ":1: lens model 'OPENGL' is not one of COLMAP's");
  EXPECT_EQ(ErrorOf("1 PINHOLE 640 480 500 nan 320 240"),
            ":1: \"nan\" for a parameter of the lens, expected a finite number");
  EXPECT_EQ(ErrorOf("1 PINHOLE 640 480 500 500 320"), ":1: 3 parameters, expected 4 of PINHOLE");
  EXPECT_EQ(ErrorOf("1.5 PINHOLE 640 480 500 500 320 240"),
            ":1: camera id is \"1.5\", expected a whole number");
}

}  // namespace
}  // namespace insitu
