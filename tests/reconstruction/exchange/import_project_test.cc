// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/lens_residual.h"
#include "reconstruction/exchange/import_aicon.h"
#include "reconstruction/exchange/import_dbat.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "tests/reconstruction/exchange/text_files.h"

namespace insitu {
namespace {

// ---- AICON: one photo from 1 m above, looking down ------------------------------------------

const char kIor[] = "1 -999 -28.0 0 0 0 0 13\n0\n0 0\n0 0\n36.0 24.0 3600 2400\n";
const char kEor[] = "7 1 100 200 1000 0 0 0 0 307 3\n";
const char kObc[] =
    "1 100 200 0 0.01 0.01 0.01 1 1 1 0\n2 300 100 0 1 1 1 1 1 1 0\n3 1 1 1 1 1 1 1 0 1 0\n";
const char kPhc[] =
    "7 1 0 0 0 0 0 0 1 1 1\n7 2 5.6 -2.8 0 0 0 0 1 1 1\n7 2 9 9 0 0 0 0 1 0 1\n7 4 1 1 0 0 0 0 1 1 "
    "1\n";
const char kScale[] = "0 \"Scale bar\" 1 2 223.6 0.01 1\n";

class AiconProject : public TextFiles {
 protected:
  AiconProject() {
    Write("a.ior", kIor);
    Write("a.eor", kEor);
    Write("a.obc", kObc);
    Write("a.phc", kPhc);
    Write("a.scale", kScale);
  }
};

TEST_F(AiconProject, IsReadInMetresAndPixels) {
  const ImportedProject project = ReadAiconProject(folder_);
  const Network& network = project.network;
  ASSERT_EQ(network.points.size(), 2u);  // the third is flagged
  EXPECT_NEAR(network.points[1].position.x(), 0.3, 1e-15);
  ASSERT_EQ(network.marks.size(), 2u);  // one flagged, one of no point
  EXPECT_EQ(project.remarks.size(), 3u);
  EXPECT_NEAR(network.marks[1].pixel.x(), 1799.5 + 560, 1e-9);
  EXPECT_NEAR(network.marks[1].pixel.y(), 1199.5 + 280, 1e-9);
  EXPECT_NEAR(network.marks[1].sigma_px, 0.05, 1e-15);
  ASSERT_EQ(network.distances.size(), 1u);
  EXPECT_NEAR(network.distances[0].distance, 0.2236, 1e-15);
  EXPECT_NEAR(network.distances[0].sigma, 1e-5, 1e-18);
  for (const MarkObservation& mark : network.marks) {
    const NetworkPhoto& photo = network.photos[mark.photo];
    const Eigen::Vector3d in_cam =
        photo.cam_from_local * (network.points[mark.point].position - photo.center);
    Eigen::Vector2d residual;
    const Lens& lens = network.cameras[0].lens;
    ASSERT_TRUE(LensResidual(lens, LensParameters(lens).data(), in_cam, mark.pixel, &residual, {}));
    EXPECT_NEAR(residual.norm(), 0, 1e-9);
  }
}

TEST_F(AiconProject, FaultsAreNamedWithTheirLine) {
  const auto read = [&] { ReadAiconProject(folder_); };
  Write("a.ior", "1 -999 28.0 0 0 0 0 13\n0\n0 0\n0 0\n36.0 24.0 3600 2400\n");
  ExpectError(read, "a.ior", 1, "negative");
  Write("a.ior", "1 -999 -28.0 0 0 0 0 13\n0\n0 0\n");
  ExpectError(read, "a.ior", 3, "within a camera");
  Write("a.ior", kIor);
  Write("a.eor", std::string(kEor) + "8 2 0 0 0 0 0 0 0 307 3\n");
  ExpectError(read, "a.eor", 2, "camera \"2\"");
  Write("a.eor", std::string(kEor) + kEor);
  ExpectError(read, "a.eor", 2, "twice");
  Write("a.eor", kEor);
  Write("a.phc", "7 1 0 0\n9 1 0 0\n");
  ExpectError(read, "a.phc", 2, "photo \"9\"");
  Write("a.phc", "7 1 0 nan\n");
  ExpectError(read, "a.phc", 1, "finite");
  Write("a.phc", kPhc);
  Write("a.scale", "0 bar 1 5 223.6 0.01 1\n");
  ExpectError(read, "a.scale", 1, "no coordinates");
  Write("b.phc", kPhc);
  ExpectError(read, "", 0, "2 files");
}

TEST_F(AiconProject, NothingCrashesOnCutFiles) {
  const auto read = [&](const std::filesystem::path&) { ReadAiconProject(folder_ / "a.phc"); };
  ExpectNoHarmWhenCut("a.ior", kIor, read);
  ExpectNoHarmWhenCut("a.eor", kEor, read);
  ExpectNoHarmWhenCut("a.scale", kScale, read);
}

TEST_F(AiconProject, OptionsNameTheFieldThatIsWrong) {
  try {
    ReadAiconProject(folder_, {.mark_sigma_mm = 0});
    ADD_FAILURE();
  } catch (const CheckError& error) {
    EXPECT_NE(std::string(error.what()).find("mark_sigma_mm"), std::string::npos) << error.what();
  }
}

// ---- DBAT: two photos from above, a square of control and one point ---------------------------

const char kScript[] =
    "<?xml version=\"1.0\"?>\n<document dbat_script_version=\"1.0\">\n<input base_dir=\"$HERE\">\n"
    "<ctrl_pts><file format=\"id,label,x,y,z,sxyz\">control.txt</file>\n"
    "<filter id=\"9\">remove</filter></ctrl_pts>\n"
    "<check_pts><file format=\"id,label,x,y,z,sxyz\">control.txt</file>\n"
    "<filter id=\"9\">keep</filter></check_pts>\n"
    "<images image_base_dir=\"$DBAT\"><file format=\"id,path\">images.txt</file></images>\n"
    "<image_pts><file format=\"im,id,x,y\" sxy=\"0.5\">marks.txt</file></image_pts>\n"
    "<cameras><camera><id>1</id><name>c</name><unit>mm</unit><sensor>auto,24</sensor>\n"
    "<image>3600,2400</image><focal>30</focal><model>3</model><nK>3</nK><nP>2</nP>\n"
    "</camera></cameras></input>\n"
    "<operations><operation min_rays=\"2\">check_ray_count</operation>\n"
    "<operation><set_initial_values><io><all>default</all></io></set_initial_values></operation>\n"
    "<operation><set_bundle_estimate_params><io><all>true</all><skew>false</skew>\n"
    "<K3>false</K3></io><eo><all>true</all></eo></set_bundle_estimate_params></operation>\n"
    "</operations></document>\n";

class DbatProject : public TextFiles {
 protected:
  DbatProject() {
    Write("script.xml", kScript);
    Write("control.txt",
          "1,A,0,0,0,0\n2,B,10,0,0,0.01\n3,C,10,10,1,0.01\n4,D,0,10,2,0.01\n9,K,5,5,3,0.02\n");
    Write("images.txt", "# id, path\n1, photos/left.jpg\n2, photos/right.jpg\n");
    Write("marks.txt", Marks());
  }

  // Seen from 20 m above by a lens without distortion, in DBAT's pixels.
  static std::string Marks() {
    const std::map<std::string, Eigen::Vector3d> points = {{"1", {0, 0, 0}},   {"2", {10, 0, 0}},
                                                           {"3", {10, 10, 1}}, {"4", {0, 10, 2}},
                                                           {"9", {5, 5, 3}},   {"20", {3, 6, 1}}};
    std::string marks = "1,99,5,5\n";  // a point with one ray
    for (int image = 1; image <= 2; ++image) {
      const Eigen::Vector3d center(3.0 + 2 * image, 5, 20);
      for (const auto& [id, point] : points) {
        const Eigen::Vector3d ray = point - center;
        const double x = 18 - 30 * ray.x() / ray.z(), y = 12 + 30 * ray.y() / ray.z();  // [mm]
        marks += std::to_string(image) + "," + id + "," + std::to_string(x * 100) + "," +
                 std::to_string(y * 100) + "\n";
      }
    }
    return marks;
  }
};

TEST_F(DbatProject, IsReadWithStartValues) {
  const ImportedProject project = ReadDbatProject(folder_ / "script.xml");
  const Network& network = project.network;
  ASSERT_EQ(network.photos.size(), 2u);
  EXPECT_EQ(network.photos[1].name, "right");
  EXPECT_NEAR((network.photos[0].center - Eigen::Vector3d(5, 5, 20)).norm(), 0, 1e-5);
  EXPECT_NEAR((network.photos[1].center - Eigen::Vector3d(7, 5, 20)).norm(), 0, 1e-5);
  EXPECT_EQ(network.points.size(), 6u);
  EXPECT_TRUE(network.points[0].is_fixed);
  EXPECT_EQ(network.control.size(), 3u);
  EXPECT_EQ(network.marks.size(), 12u);
  ASSERT_EQ(project.check_points.size(), 1u);
  EXPECT_EQ(network.points[project.check_points[0].point].name, "9");
  EXPECT_EQ(project.check_points[0].position, Eigen::Vector3d(5, 5, 3));
  for (const NetworkPoint& point : network.points) {
    if (point.name != "20") continue;
    EXPECT_NEAR((point.position - Eigen::Vector3d(3, 6, 1)).norm(), 0, 1e-5);
  }
  EXPECT_EQ(network.cameras[0].is_free,
            (std::vector<bool>{true, true, true, true, true, false, true, true, true, false}));
  EXPECT_EQ(network.marks[0].sigma_px, 0.5);
}

TEST_F(DbatProject, FaultsAreNamedWithTheirLine) {
  const auto read = [&] { ReadDbatProject(folder_ / "script.xml"); };
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string script = kScript;
    script.replace(script.find(from), from.size(), to);
    Write("script.xml", script);
  };
  replaced("<model>3", "<model>-1");
  ExpectError(read, "script.xml", 11, "lens model -1");
  replaced("<unit>mm", "<unit>px");
  ExpectError(read, "script.xml", 10, "mm");
  replaced("control.txt", "nowhere.txt");
  ExpectError(read, "script.xml", 4, "nowhere.txt");
  replaced("$HERE", "$DBAT");
  ExpectError(read, "script.xml", 3, "$HERE");
  replaced(" sxy=\"0.5\"", "");
  ExpectError(read, "script.xml", 9, "sigma");
  replaced("<filter id=\"9\">remove", "<filter id=\"9\">maybe");
  ExpectError(read, "script.xml", 5, "keep or remove");
  replaced("<K3>", "<K9>");
  EXPECT_THROW(read(), InputError);
  Write("script.xml", kScript);
  Write("marks.txt", "1,1,5\n");
  ExpectError(read, "marks.txt", 1, "3 values, expected 4");
  Write("marks.txt", "1,1,5,5\n3,1,5,5\n");
  ExpectError(read, "marks.txt", 2, "image \"3\"");
  Write("marks.txt", "1,1,5,5\n1,2,6,7\n2,1,5,5\n");
  ExpectError(read, "images.txt", 2, "cannot be placed");
  Write("marks.txt", Marks());
  Write("control.txt", "1,A,0,0,0,0\n1,B,1,1,1,0\n");
  ExpectError(read, "control.txt", 2, "stands also");
}

TEST_F(DbatProject, NothingCrashesOnCutFiles) {
  const auto read = [&](const std::filesystem::path&) { ReadDbatProject(folder_ / "script.xml"); };
  ExpectNoHarmWhenCut("script.xml", kScript, read);
  ExpectNoHarmWhenCut("images.txt", "1,left.jpg\n2,right.jpg\n", read);
}

// ---- conventions ---------------------------------------------------------------------------

TEST(OmegaPhiKappaAngles, ReturnFromTheirRotation) {
  for (const Eigen::Vector3d& angles :
       {Eigen::Vector3d(0.1, -0.2, 0.3), Eigen::Vector3d(3, 1.2, -2.5),
        Eigen::Vector3d(-2, -1, 1)}) {
    EXPECT_NEAR((OmegaPhiKappa(CamFromWorldOmegaPhiKappa(angles)) - angles).norm(), 0, 1e-12);
  }
  // Without any turn the camera looks down, its x along the world's.
  const Eigen::Quaterniond down = CamFromWorldOmegaPhiKappa({0, 0, 0});
  EXPECT_NEAR((down * Eigen::Vector3d(0, 0, -1) - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-15);
  EXPECT_NEAR((down * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d::UnitX()).norm(), 0, 1e-15);
  const Eigen::Quaterniond gimbal = CamFromWorldOmegaPhiKappa({0.4, M_PI / 2, 0.3});
  const Eigen::Quaterniond again = CamFromWorldOmegaPhiKappa(OmegaPhiKappa(gimbal));
  EXPECT_NEAR(gimbal.angularDistance(again), 0, 1e-7);
}

}  // namespace
}  // namespace insitu
