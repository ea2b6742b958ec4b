// SPDX-License-Identifier: GPL-3.0-or-later
// Projects of AICON and DBAT, read and held against what those programs printed.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "calibration/camera_files/dbat_camera.h"
#include "calibration/files/text_table.h"
#include "calibration/files/whole_file.h"
#include "calibration/lens/lens_residual.h"
#include "reconstruction/exchange/import_aicon.h"
#include "reconstruction/exchange/import_dbat.h"
#include "reconstruction/network/solve_network.h"
#include "tests/shared_data.h"

namespace insitu {
namespace {

std::vector<Eigen::Vector2d> MarkResiduals(const Network& network) {
  std::vector<Eigen::Vector2d> residuals;
  for (const MarkObservation& mark : network.marks) {
    const NetworkPhoto& photo = network.photos[mark.photo];
    const Eigen::Vector3d in_cam =
        photo.cam_from_local * (network.points[mark.point].position - photo.center);
    const Lens& lens = network.cameras[photo.camera].lens;
    Eigen::Vector2d residual(1e9, 1e9);
    LensResidual(lens, LensParameters(lens).data(), in_cam, mark.pixel, &residual, {});
    residuals.push_back(residual);
  }
  return residuals;
}

double RmsPx(const Network& network) {
  double sum = 0;
  for (const Eigen::Vector2d& residual : MarkResiduals(network)) sum += residual.squaredNorm();
  return std::sqrt(sum / static_cast<double>(network.marks.size()));
}

TEST(AiconReference, EveryResidualIsTheOneThatAiconWroteBesideItsMark) {
  INSITU_SHARED_DATA_OR_SKIP(folder, "adjustment/jaicov_aicon");
  const ImportedProject project = ReadAiconProject(folder);
  const Network& network = project.network;
  for (const std::string& remark : project.remarks) std::printf("%s\n", remark.c_str());
  EXPECT_EQ(network.photos.size(), 115u);
  EXPECT_EQ(network.points.size(), 150u);
  EXPECT_EQ(network.distances.size(), 1u);
  ASSERT_EQ(2 * network.marks.size() + network.distances.size(), 19945u);  // n of example.htm
  const auto& lens = std::get<MetricCamera>(network.cameras[0].lens);
  std::map<std::pair<std::string, std::string>, Eigen::Vector2d> printed_mm;
  for (const TextRow& row : ReadTextRows(folder / "example.phc", WordSeparator::kBlanks)) {
    printed_mm[{row.words[0], row.words[1]}] = {row.Number(6, "vx"), row.Number(7, "vy")};
  }
  const std::vector<Eigen::Vector2d> residuals = MarkResiduals(network);
  double largest_mm = 0;
  for (size_t i = 0; i < residuals.size(); ++i) {
    const MarkObservation& mark = network.marks[i];
    const Eigen::Vector2d mm(lens.pixel_mm.x() * residuals[i].x(),
                             -lens.pixel_mm.y() * residuals[i].y());
    const auto& printed =
        printed_mm.at({network.photos[mark.photo].name, network.points[mark.point].name});
    largest_mm = std::max(largest_mm, (mm - printed).norm());
  }
  std::printf("AICON: largest difference of a residual %.2e mm\n", largest_mm);
  EXPECT_LT(largest_mm, 1e-5);
}

// DBAT's script solved by us: sigma0 and the overall RMS as its report prints them.
void ExpectPrinted(const std::filesystem::path& script, double sigma0, int redundancy,
                   double rms_px) {
  Network network = ReadDbatProject(script).network;
  const NetworkSolution solution = SolveNetwork(&network);
  std::printf("%s: sigma0 %.6f, r %d, RMS %.4f px\n", script.filename().c_str(), solution.sigma0,
              solution.redundancy, RmsPx(network));
  EXPECT_NEAR(solution.sigma0, sigma0, 5e-6 * sigma0);
  EXPECT_EQ(solution.redundancy, redundancy);
  EXPECT_NEAR(RmsPx(network), rms_px, 5e-4);
}

TEST(DbatReference, CameraCalibration) {
  INSITU_SHARED_DATA_OR_SKIP(folder, "calibration/dbat_camcal_c4040z/script");
  ExpectPrinted(folder / "camcaldemo.xml", 1.6148, 3725, 0.216);
}

TEST(DbatReference, CalibratedCameraHasTheDigitsOfItsFile) {
  INSITU_SHARED_DATA_OR_SKIP(folder, "calibration/dbat_camcal_c4040z/script");
  Network network = ReadDbatProject(folder / "camcaldemo.xml").network;
  SolveNetwork(&network);
  const DbatCamera ours = DbatFromMetric(std::get<MetricCamera>(network.cameras[0].lens));
  const XmlNode file = XmlNode::Load(folder / "result/c4040z.xml").At("cameras").At("camera");
  const DbatCamera theirs = ParseDbatCamera(file);
  EXPECT_NEAR(ours.cc_mm, theirs.cc_mm, 0.01 * 0.00105);  // a hundredth of its sigma
  EXPECT_NEAR(ours.pp_mm.x(), theirs.pp_mm.x(), 0.01 * 0.00082);
  EXPECT_NEAR(ours.pp_mm.y(), theirs.pp_mm.y(), 0.01 * 0.00098);
  EXPECT_NEAR(ours.aspect, theirs.aspect, 0.01 * 2.08e-5);
  EXPECT_NEAR(ours.K[0], theirs.K[0], 0.01 * 2.21e-5);
  EXPECT_NEAR(ours.K[1], theirs.K[1], 0.01 * 2.65e-6);
  EXPECT_NEAR(ours.K[2], theirs.K[2], 0.01 * 1.01e-7);
  EXPECT_NEAR(ours.P[0], theirs.P[0], 0.01 * 3.52e-6);
  EXPECT_NEAR(ours.P[1], theirs.P[1], 0.01 * 3.94e-6);
}

TEST(DbatReference, Strasbourg) {
  INSITU_SHARED_DATA_OR_SKIP(folder, "adjustment/sxb_aerial/script");
  ExpectPrinted(folder / "sxb.xml", 1.1786, 1261, 1.101);
  const ImportedProject project = ReadDbatProject(folder / "sxb.xml");
  EXPECT_EQ(project.check_points.size(), 2u);
  EXPECT_EQ(project.network.control.size(), 14u);
}

// The values of one kind in a report of DBAT, photo by photo.
std::vector<std::string> PrintedValues(const std::string& report, const std::string& heading) {
  std::vector<std::string> values;
  for (size_t at = 0; (at = report.find(heading, at)) != std::string::npos; ++at) {
    const size_t value = report.find("Value:", at) + 6;
    values.push_back(SplitAtBlanks(report.substr(value, 40))[0]);
  }
  return values;
}

// The arch's photos and lens as printed, its points by intersection: the RMS is the printed one,
// but for the points' being intersected in space, not adjusted in the photos.
TEST(DbatReference, RomanArchAsPrinted) {
  INSITU_SHARED_DATA_OR_SKIP(folder, "adjustment/roma_arch/script");
  const std::filesystem::path copy = std::filesystem::path(testing::TempDir()) / "roma_as_printed";
  std::filesystem::remove_all(copy);
  std::filesystem::copy(folder, copy, std::filesystem::copy_options::recursive);
  const std::string report = ReadTextFile(folder / "result/report.txt");
  std::vector<std::vector<std::string>> columns;
  for (const char* name : {"Xc:\n", "Yc:\n", "Zc:\n", "Omega:\n", "Phi:\n", "Kappa:\n"}) {
    columns.push_back(PrintedValues(report, name));
    ASSERT_EQ(columns.back().size(), 60u);
  }
  std::string table;
  for (size_t i = 0; i < 60; ++i) {
    table += std::to_string(i + 1);
    for (const auto& column : columns) table += "," + column[i];
    table += "\n";
  }
  WriteWhole(copy / "prior/initial_eo.txt", table);
  std::filesystem::copy_file(folder / "result/EOS5DMarkII.xml", copy / "cameras/EOS5DMarkII.xml",
                             std::filesystem::copy_options::overwrite_existing);
  const Network network = ReadDbatProject(copy / "romabundledemo.xml").network;
  std::printf("roma_arch as printed: RMS %.4f px\n", RmsPx(network));
  EXPECT_EQ(network.marks.size(), 90561u);
  EXPECT_EQ(network.points.size(), 26321u);
  EXPECT_NEAR(RmsPx(network), 0.618, 0.004);
}

}  // namespace
}  // namespace insitu
