// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/read_camera_file.h"

#include <cmath>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

const std::string kOpencv =
    "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n"
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 536., 0., 342.5, 0., 537., 235.5, 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
    "   data: [ -0.26, -0.038, 1.7e-3, -2.8e-4, 0.238 ]\n";

class CameraFiles : public testing::Test {
 protected:
  CameraFile Read(const std::string& name, const std::string& text,
                  const CameraFileOptions& options = {}) {
    return ReadCameraFile(folder_.Write(name, text), options);
  }
  // The message behind the file's path.
  std::string ErrorOf(const std::string& name, const std::string& text,
                      const CameraFileOptions& options = {}) {
    const auto path = folder_.Write(name, text);
    const std::string message = InputErrorOf([&] { ReadCameraFile(path, options); });
    EXPECT_EQ(message.find(path.string()), 0u) << message;
    return message.substr(path.string().size());
  }
  ScratchFolder folder_;
};

TEST_F(CameraFiles, OpencvYaml) {
  const CameraFile file = Read("camera.yml", kOpencv);
  EXPECT_EQ(file.camera.lens_model(), "LENSMODEL_OPENCV5");
  EXPECT_EQ(file.camera.intrinsics(),
            (std::vector<double>{536, 537, 342.5, 235.5, -0.26, -0.038, 1.7e-3, -2.8e-4, 0.238}));
  EXPECT_EQ(file.camera.width(), 640);
  EXPECT_EQ(file.largest_deviation_px, 0);
}

TEST_F(CameraFiles, StereoPairNeedsASideAndASize) {
  const std::string pair =
      "%YAML:1.0\nM1: { rows: 3, cols: 3, dt: d, data: [500, 0, 320, 0, 500, 240, 0, 0, 1] }\n"
      "D1: { data: [0.1, 0, 0, 0] }\n"
      "M2: { rows: 3, cols: 3, dt: d, data: [510, 0, 320, 0, 510, 240, 0, 0, 1] }\n"
      "D2: { data: [0.2, 0, 0, 0] }\n";
  EXPECT_NE(ErrorOf("a.yml", pair).find("holds two cameras"), std::string::npos);
  EXPECT_NE(ErrorOf("a.yml", pair, {std::nullopt, "left"}).find("size of its photographs"),
            std::string::npos);
  const CameraFile right = Read("a.yml", pair, {Eigen::Vector2i(640, 480), "right"});
  EXPECT_EQ(right.camera.intrinsics()[0], 510);
  EXPECT_EQ(right.camera.intrinsics()[4], 0.2);
}

TEST_F(CameraFiles, RosAndItsFisheye) {
  const std::string ros =
      "image_width: 640\nimage_height: 480\ncamera_name: head\n"
      "camera_matrix: {rows: 3, cols: 3, data: [400, 0, 319.5, 0, 400, 239.5, 0, 0, 1]}\n";
  EXPECT_EQ(Read("a.yaml", ros + "distortion_model: plumb_bob\n"
                                 "distortion_coefficients: {rows: 1, cols: 5, data: "
                                 "[0.1, 0.2, 0.01, 0.02, 0.3]}\n")
                .camera.lens_model(),
            "LENSMODEL_OPENCV5");
  const CameraFile fisheye = Read("b.yaml", ros +
                                                "distortion_model: equidistant\n"
                                                "distortion_coefficients: {data: [0, 0, 0, 0]}\n");
  EXPECT_GT(fisheye.largest_deviation_px, 0);
  EXPECT_LT(fisheye.largest_deviation_px, 0.05);
  // Equidistant: the angle off the axis is the distance from the middle.
  const auto pixel = fisheye.camera.Project({std::tan(0.6), 0, 1});
  EXPECT_NEAR(pixel->x(), 319.5 + 400 * 0.6, 0.05);
}

TEST_F(CameraFiles, Boofcv) {
  const CameraFile file = Read(
      "intrinsic.yaml",
      "pinhole:\n  fx: 701.0\n  fy: 698.6\n  cx: 308.4\n  cy: 246.8\n  width: 640\n  height: 480\n"
      "  skew: 0.0\nmodel: pinhole_radial_tangential\nradial_tangential:\n  radial:\n  - -0.25\n"
      "  - 0.1\n  t1: 0.001\n  t2: 0.002\n");
  EXPECT_EQ(file.camera.intrinsics(),
            (std::vector<double>{701.0, 698.6, 308.4, 246.8, -0.25, 0.1, 0.001, 0.002, 0}));
}

TEST_F(CameraFiles, FaultsOfYaml) {
  EXPECT_NE(ErrorOf("a.yml", "%YAML:1.0\n").find("no camera in it"), std::string::npos);
  EXPECT_NE(ErrorOf("a.yml", "a: [1, 2\n").find("not YAML"), std::string::npos);
  EXPECT_NE(ErrorOf("a.yml", "width: 3\n").find("expected camera_matrix"), std::string::npos);
  const size_t cut = kOpencv.find("537");
  EXPECT_NE(ErrorOf("a.yml", kOpencv.substr(0, cut)).find("not YAML"), std::string::npos);
  std::string text = kOpencv;
  text.replace(text.find("536."), 4, ".nan");
  EXPECT_EQ(ErrorOf("a.yml", text), ":9: expected a finite number");
}

TEST_F(CameraFiles, ColmapCountsFromThePixelsCorner) {
  const CameraFile file = Read("cameras.txt",
                               "# Camera list with one line of data per camera:\n"
                               "3 OPENCV 1000 800 900 905 500.5 400.5 0.1 0.01 1e-3 2e-3\n");
  EXPECT_EQ(file.camera.lens_model(), "LENSMODEL_OPENCV4");
  EXPECT_EQ(file.camera.intrinsics(),
            (std::vector<double>{900, 905, 500, 400, 0.1, 0.01, 1e-3, 2e-3}));
}

TEST_F(CameraFiles, ColmapModelsOfOneFocalLength) {
  EXPECT_EQ(Read("cameras.txt", "1 SIMPLE_PINHOLE 1000 800 900 500 400\n").camera.intrinsics(),
            (std::vector<double>{900, 900, 499.5, 399.5}));
  EXPECT_EQ(Read("cameras.txt", "1 RADIAL 1000 800 900 500 400 0.1 0.2\n").camera.intrinsics(),
            (std::vector<double>{900, 900, 499.5, 399.5, 0.1, 0.2, 0, 0}));
}

// tan(r w) / (2 tan(w / 2)), [Devernay & Faugeras 2001]; and the thin prism without distortion.
TEST_F(CameraFiles, ColmapModelsThatAreFitted) {
  const CameraFile fov = Read("cameras.txt", "1 FOV 1000 800 900 900 500 400 0.9\n");
  EXPECT_LT(fov.largest_deviation_px, 0.05);
  const double tangent = std::tan(0.3 * 0.9) / (2 * std::tan(0.45));
  EXPECT_NEAR(fov.camera.Project({tangent, 0, 1})->x(), 499.5 + 900 * 0.3, 0.05);
  const CameraFile prism =
      Read("cameras.txt", "1 THIN_PRISM_FISHEYE 1000 800 900 900 500 400 0 0 0 0 0 0 0 0\n");
  EXPECT_NEAR(prism.camera.Project({std::tan(0.3), 0, 1})->x(), 499.5 + 900 * 0.3, 0.05);
}

TEST_F(CameraFiles, FaultsOfColmap) {
  const std::string two =
      "1 PINHOLE 1000 800 900 900 500 400\n2 PINHOLE 1000 800 950 950 500 400\n";
  EXPECT_NE(ErrorOf("cameras.txt", two).find("holds 2 cameras, 1 2"), std::string::npos);
  EXPECT_EQ(Read("cameras.txt", two, {std::nullopt, "2"}).camera.focal_px(), 950);
  EXPECT_EQ(ErrorOf("cameras.txt", "1 OPENCV 1000 800 900\n"),
            ":1: 1 parameters, expected 8 of OPENCV");
  EXPECT_NE(ErrorOf("cameras.txt", "1 EUCM 1000 800 900 9 9 9 1 1\n").find("is not read"),
            std::string::npos);
  EXPECT_EQ(ErrorOf("cameras.txt", "1 PINHOLE 1000\n"),
            ":1: cut short, expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS");
  EXPECT_NE(
      ErrorOf("cameras.txt", "1 PINHOLE 0 800 900 900 500 400\n").find("a frame without pixels"),
      std::string::npos);
}

const std::string kDbat =
    "<?xml version=\"1.0\"?>\n<document dbat_camera_version=\"1.0\"><cameras><camera>\n"
    "<id>1</id><sensor>auto,5.4</sensor><image>2272,1704</image><aspect>1</aspect>\n"
    "<model>3</model><cc>7.5</cc><pp>3.6,2.7</pp><skew>0</skew>\n"
    "<K>0.004,-4e-5</K><P>-6e-5,-4e-5</P>\n</camera></cameras></document>\n";

TEST_F(CameraFiles, Dbat) {
  const CameraFile file = Read("c4040z.xml", kDbat);
  ASSERT_TRUE(file.metric);
  EXPECT_EQ(file.metric->model, MetricModel::kBackwardBrown);
  EXPECT_EQ(file.metric->parameters,
            (std::vector<double>{7.5, 3.6, -2.7, 0.004, -4e-5, 0, -6e-5, -4e-5, 0, 0}));
  EXPECT_LT(file.largest_deviation_px, 0.1);
  // The principal point is undistorted: 3.6 mm from the left edge, 2.7 mm from the top.
  const Eigen::Vector2d center = *file.camera.Project({0, 0, 1});
  EXPECT_NEAR(center.x(), 3.6 * 1704 / 5.4 - 0.5, 0.05);
  EXPECT_NEAR(center.y(), 2.7 * 1704 / 5.4 - 0.5, 0.05);
}

TEST_F(CameraFiles, FaultsOfDbat) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kDbat;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_NE(ErrorOf("a.xml", kDbat.substr(0, 200)).find("is not valid XML"), std::string::npos);
  EXPECT_EQ(ErrorOf("a.xml", with("7.5", "7.5,0")), ":4: <cc>: 2 numbers, expected 1");
  EXPECT_EQ(ErrorOf("a.xml", with("<cc>7.5</cc>", "")), ":2: <camera>: <cc> is missing");
  EXPECT_NE(ErrorOf("a.xml", with("<model>3", "<model>-3")).find("expected 3, or 1 or 2"),
            std::string::npos);
  EXPECT_NE(ErrorOf("a.xml", "<html/>").find("no camera in it"), std::string::npos);
}

TEST_F(CameraFiles, Aicon) {
  const std::string ior =
      "1 -999 -28.8 0.02 0.06 -1.1e-004 1.5e-007 13.5\n0.0e+000\n5.8e-006 -8.6e-006\n"
      "-7.0e-005 0.0e+000\n36 24 8688 5792\n";
  const CameraFile file = Read("camera.ior", ior);
  ASSERT_TRUE(file.metric);
  EXPECT_EQ(file.metric->parameters,
            (std::vector<double>{28.8, 0.02, 0.06, -1.1e-4, 1.5e-7, 0, 5.8e-6, -8.6e-6, -7e-5, 0}));
  EXPECT_EQ(file.metric->balanced_radius_mm, 13.5);
  EXPECT_LT(file.largest_deviation_px, 0.01);
  EXPECT_NE(ErrorOf("camera.ior", ior.substr(0, 40)).find("expected 17 a camera"),
            std::string::npos);
  EXPECT_NE(ErrorOf("camera.ior", "x" + ior).find("expected a finite number"), std::string::npos);
}

TEST_F(CameraFiles, OpensfmAndCertificates) {
  const CameraFile opensfm =
      Read("camera_models.json",
           R"({"v2 phone": {"projection_type": "perspective", "width": 3264, "height": 2448,
          "focal": 0.87, "k1": 0.09, "k2": -0.23}})");
  EXPECT_EQ(opensfm.camera.intrinsics()[2], (3264 - 1) / 2.0);
  EXPECT_NEAR(opensfm.camera.focal_px(), 0.87 * 3264, 1e-9);
  const std::string metric =
      R"({"metric": "backward_brown", "width": 3000, "height": 2000, "pixel_mm": [0.008, 0.008],
          "origin": "middle", "parameters": {"c": 24, "K1": 1e-4}})";
  const CameraFile certificate = Read("camera.json", metric);
  EXPECT_NEAR(certificate.camera.Project({0, 0, 1})->x(), 1499.5, 0.01);
  std::string wrong = metric;
  wrong.replace(wrong.find("K1"), 2, "K9");
  EXPECT_NE(ErrorOf("camera.json", wrong).find("is unknown, expected one of c xp yp"),
            std::string::npos);
}

TEST_F(CameraFiles, NoCameraFile) {
  EXPECT_NE(ErrorOf("notes.txt", "hello").find("no camera file that is read"), std::string::npos);
  EXPECT_NE(ErrorOf("camera.cameramodel", "{ 'lensmodel': ").find("not a camera model"),
            std::string::npos);
}

TEST_F(CameraFiles, OptionsNameTheFieldThatIsWrong) {
  try {
    Read("camera.yml", kOpencv, {Eigen::Vector2i(0, 480), ""});
    ADD_FAILURE();
  } catch (const CheckError& error) {
    EXPECT_NE(std::string(error.what()).find("photo_size"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace insitu
