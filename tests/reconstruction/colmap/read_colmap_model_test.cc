// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/read_colmap_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/colmap/colmap_binary.h"
#include "reconstruction/colmap/colmap_text.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Ids with gaps, a blank in a name, a keypoint of no point, an image without keypoints.
ColmapModel SmallModel() {
  ColmapModel model;
  model.cameras[7] = {"OPENCV", 1800, 1200, {1500, 1502, 900, 602, -0.1, 0.03, 1e-4, -2e-4}};
  model.cameras[9] = {"EUCM", 640, 480, {300, 301, 320, 240, 0.6, 1.1}};
  const Rigid3 pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())),
                    {1.0 / 3, -2, 2600000.123456789}};
  model.images[12] = {"north face.jpg", 7, pose, {{{10.25, 20.5}, 99}, {{1, 2}, std::nullopt}}};
  model.images[4] = {"b.jpg", 7, {}, {{{100.125, 7}, 99}}};
  model.images[30] = {"empty.jpg", 9, {}, {}};
  model.points[99] = {{0.1, 0.2, 3}, {1, 2, 255}, 0.75, {{12, 0}, {4, 0}}};
  return model;
}

void ExpectEqual(const ColmapModel& a, const ColmapModel& b) {
  EXPECT_EQ(a.cameras, b.cameras);
  ASSERT_EQ(a.images.size(), b.images.size());
  for (const auto& [id, image] : a.images) {
    const ColmapImage& other = b.images.at(id);
    EXPECT_EQ(image.name, other.name);
    EXPECT_EQ(image.camera, other.camera);
    EXPECT_EQ(image.keypoints, other.keypoints);
    EXPECT_TRUE(image.cam_from_world.rotation.isApprox(other.cam_from_world.rotation, 1e-15));
    EXPECT_EQ(image.cam_from_world.translation, other.cam_from_world.translation);
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (const auto& [id, point] : a.points) {
    EXPECT_EQ(point.position, b.points.at(id).position);
    EXPECT_EQ(point.rgb, b.points.at(id).rgb);
    EXPECT_EQ(point.error_px, b.points.at(id).error_px);
    EXPECT_EQ(point.track, b.points.at(id).track);
  }
}

class ColmapFolder : public testing::Test {
 protected:
  ColmapFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / "colmap_model" / test->name();
    fs::remove_all(folder_);
  }

  std::string Fault() const {
    try {
      ReadColmapModel(folder_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  // Reads with one piece of a file replaced, and puts the file right again.
  std::string FaultWith(const std::string& file, const std::string& from, const std::string& to) {
    const std::string content = ReadWhole(folder_ / file);
    const size_t place = content.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    WriteWhole(folder_ / file, std::string(content).replace(place, from.size(), to));
    const std::string fault = Fault();
    WriteWhole(folder_ / file, content);
    return fault;
  }

  fs::path folder_;
};

TEST_F(ColmapFolder, TextReturnsEveryDigit) {
  WriteColmapText(folder_, SmallModel());
  ExpectEqual(ReadColmapModel(folder_), SmallModel());
}

TEST_F(ColmapFolder, BinaryReturnsEveryBit) {
  WriteColmapBinary(folder_, SmallModel());
  ExpectEqual(ReadColmapModel(folder_), SmallModel());
}

TEST_F(ColmapFolder, BinaryWinsOverText) {
  WriteColmapBinary(folder_, SmallModel());
  WriteColmapText(folder_, {});
  EXPECT_EQ(ReadColmapModel(folder_).images.size(), 3u);
  fs::remove(folder_ / "points3D.bin");  // an incomplete set does not count
  EXPECT_EQ(ReadColmapModel(folder_).images.size(), 0u);
}

TEST_F(ColmapFolder, ReadsWhatCOLMAP4WritesBesides) {
  WriteWhole(folder_ / "rigs.txt", "# Rig list\n1 1 CAMERA 7\n");
  WriteWhole(folder_ / "frames.txt", "# Frame list\n4 1 1 0 0 0 0 0 0 1 CAMERA 7 4\n");
  WriteWhole(folder_ / "cameras.txt",
             "# Number of cameras: 1\n7 SIMPLE_DIVISION 64 48 50 32 24 0.1\n");
  WriteWhole(folder_ / "images.txt",  // unsorted, one with an empty line of keypoints
             "# Number of images: 2, mean observations per image: 0.5\n"
             "9 1 0 0 0 0 0 0 7 z.jpg\n\n4 1 0 0 0 0 0 1 7 a.jpg\r\n3.5 4.5 -1\r\n");
  WriteWhole(folder_ / "points3D.txt", "# Number of points: 0, mean track length: 0\n");
  const ColmapModel model = ReadColmapModel(folder_);
  EXPECT_TRUE(model.images.at(9).keypoints.empty());
  EXPECT_EQ(model.images.at(4).name, "a.jpg");
  EXPECT_EQ(model.images.at(4).keypoints.at(0).position, Eigen::Vector2d(3.5, 4.5));
}

TEST_F(ColmapFolder, NamesEveryCutOfABinaryFile) {
  WriteColmapBinary(folder_, SmallModel());
  for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string content = ReadWhole(folder_ / file);
    for (size_t size = 0; size < content.size(); ++size) {
      WriteWhole(folder_ / file, content.substr(0, size));
      const std::string fault = Fault();
      EXPECT_NE(fault.find(file), std::string::npos) << size << ": " << fault;
      EXPECT_NE(fault.find("at byte "), std::string::npos) << fault;
    }
    WriteWhole(folder_ / file, content + '\0');
    EXPECT_NE(Fault().find("expected the file to end here"), std::string::npos);
    WriteWhole(folder_ / file, content);
  }
}

TEST_F(ColmapFolder, NamesEveryCutOfATextFile) {
  WriteColmapText(folder_, SmallModel());
  for (const char* file : {"cameras.txt", "images.txt", "points3D.txt"}) {
    const std::string content = ReadWhole(folder_ / file);
    const size_t head = content.rfind("# Number of");
    for (size_t size = content.find('\n', head) + 1; size + 2 < content.size(); ++size) {
      WriteWhole(folder_ / file, content.substr(0, size));
      // Numbers cut within their digits cannot be told; whole entries and references can.
      if (content[size] != ' ' && content[size] != '\n') continue;
      EXPECT_NE(Fault(), "none") << file << " cut after " << size << " bytes";
    }
    WriteWhole(folder_ / file, content);
  }
}

TEST_F(ColmapFolder, NamesFileAndLineOfEachFault) {
  WriteColmapText(folder_, SmallModel());
  EXPECT_EQ(Fault(), "none");
  EXPECT_NE(FaultWith("cameras.txt", "OPENCV", "OPENGL").find("cameras.txt:4: "),
            std::string::npos);
  EXPECT_NE(FaultWith("cameras.txt", "1502", "nan").find("cameras.txt:4: "), std::string::npos);
  EXPECT_NE(FaultWith("cameras.txt", "9 EUCM", "7 EUCM").find("occurs twice"), std::string::npos);
  EXPECT_NE(FaultWith("images.txt", " 7 b.jpg", " 8 b.jpg").find("images.txt:5: "),
            std::string::npos);
  EXPECT_NE(FaultWith("images.txt", "100.125 7 99", "100.125 7 98").find("images.txt:5: "),
            std::string::npos);
  EXPECT_NE(FaultWith("points3D.txt", " 12 0 4 0", " 12 0 4 0 4 7").find("points3D.txt:4: "),
            std::string::npos);
  EXPECT_NE(FaultWith("points3D.txt", " 12 0 4 0", " 12 0").find("images.txt:5: "),
            std::string::npos);
  EXPECT_NE(FaultWith("points3D.txt", "255", "256").find("colour"), std::string::npos);
  fs::remove(folder_ / "images.txt");
  EXPECT_NE(Fault().find("no COLMAP model"), std::string::npos);
}

TEST(ColmapPixel, IsHalfAPixelFromOurs) {
  EXPECT_EQ(ColmapFromPixel({0, 0}), Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(PixelFromColmap({0.5, 0.5}), Eigen::Vector2d(0, 0));
  const Camera camera("LENSMODEL_OPENCV4", {1500, 1501, 899.5, 599.5, 0.1, 0.2, 0.3, 0.4}, 1800,
                      1200);
  const ColmapLens lens = ColmapFromCamera(camera).value();
  EXPECT_EQ(lens, (ColmapLens{"OPENCV", 1800, 1200, {1500, 1501, 900, 600, 0.1, 0.2, 0.3, 0.4}}));
  EXPECT_EQ(CameraFromColmap(lens)->intrinsics(), camera.intrinsics());
}

TEST(ColmapLens, IsTheSameLensWhereCOLMAPHasIt) {
  for (const auto& [model, count] :
       std::vector<std::pair<std::string, size_t>>{{"LENSMODEL_PINHOLE", 4},
                                                   {"LENSMODEL_OPENCV4", 8},
                                                   {"LENSMODEL_OPENCV5", 9},
                                                   {"LENSMODEL_OPENCV8", 12}}) {
    std::vector<double> intrinsics = {1500, 1501, 890, 610};
    for (size_t i = 4; i < count; ++i) intrinsics.push_back(0.01 * static_cast<double>(i));
    const Camera camera(model, intrinsics, 1800, 1200);
    const auto lens = ColmapFromCamera(camera);
    ASSERT_TRUE(lens) << model;
    const auto back = CameraFromColmap(*lens);
    ASSERT_TRUE(back) << model;
    const Eigen::Vector3d point(0.3, -0.2, 1);
    EXPECT_LT((*back->Project(point) - *camera.Project(point)).norm(), 1e-10) << model;
  }
  const Camera thin("LENSMODEL_OPENCV12",
                    {1500, 1501, 890, 610, 0, 0, 0, 0, 0, 0, 0, 0, 1e-3, 0, 0, 0}, 1800, 1200);
  EXPECT_FALSE(ColmapFromCamera(thin));
  EXPECT_FALSE(CameraFromColmap({"OPENCV_FISHEYE", 64, 48, {1, 1, 1, 1, 0, 0, 0, 0}}));
}

// SIMPLE_RADIAL f cx cy k; RADIAL f cx cy k1 k2.
TEST(ColmapLens, ReadsModelsOfOneFocalLength) {
  const auto simple = CameraFromColmap({"SIMPLE_RADIAL", 64, 48, {50, 32, 24, 0.1}});
  ASSERT_TRUE(simple);
  EXPECT_EQ(simple->intrinsics(), (std::vector<double>{50, 50, 31.5, 23.5, 0.1, 0, 0, 0}));
  const auto radial = CameraFromColmap({"RADIAL", 64, 48, {50, 32, 24, 0.1, 0.2}});
  EXPECT_EQ(radial->intrinsics(), (std::vector<double>{50, 50, 31.5, 23.5, 0.1, 0.2, 0, 0}));
}

}  // namespace
}  // namespace insitu
