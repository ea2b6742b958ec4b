// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/bumps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

const Eigen::Matrix<double, 3, 2> kPoint = Eigen::Matrix<double, 3, 2>::Zero();
const Bumps kStone{0.1, 0.2, 0.01};
const Bumps kWater{0.05, 2, 0.1, 0, Vector3d(1, 0, 0), 0.3};

BumpField FieldOf(const Bumps& bumps, const std::string& name = "m") {
  return {bumps, name, Vector3d::UnitZ(), Vector3d::Zero()};
}

// Slopes against `normal` along two directions across it.
Vector2d Slope(const Vector3d& turned, const Vector3d& normal) {
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  return -Vector2d(turned.dot(u), turned.dot(v)) / turned.dot(normal);
}

// Mean over places of a plane that hang together no more.
double MeanOver(const Vector3d& normal, const std::function<double(const Vector3d&)>& value) {
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  double sum = 0;
  constexpr int kSide = 100;
  for (int i = 0; i < kSide * kSide; ++i) {
    sum += value(0.37 * (i % kSide) * u + 0.41 * (i / kSide) * v);
  }
  return sum / (kSide * kSide);
}

double RmsSlope(const BumpField& field, const Vector3d& normal) {
  return std::sqrt(MeanOver(normal, [&](const Vector3d& p) {
    return Slope(field.At(p, normal, kPoint).normal, normal).squaredNorm();
  }));
}

TEST(BumpField, HasItsStatedSlopeOnEveryPlane) {
  const BumpField stone = FieldOf(kStone);
  for (const Vector3d& normal :
       {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(0.6, 0, 0.8), Vector3d(0.48, 0.64, -0.6)}) {
    EXPECT_NEAR(RmsSlope(stone, normal), 0.1, 0.006) << normal.transpose();
  }
  EXPECT_NEAR(RmsSlope(FieldOf(kWater), Vector3d::UnitZ()), 0.05, 0.0015);
}

TEST(BumpField, SlopesAreNearlyGaussian) {
  const BumpField stone = FieldOf(kStone);
  const Vector3d up = Vector3d::UnitZ();
  const auto moment = [&](int power) {
    return MeanOver(up, [&](const Vector3d& p) {
      return std::pow(Slope(stone.At(p, up, kPoint).normal, up).x(), power);
    });
  };
  const double variance = moment(2);
  EXPECT_NEAR(moment(1), 0, 0.002);
  EXPECT_NEAR(moment(4) / (variance * variance), 3, 0.25);
}

TEST(BumpField, WavesRunAlongTheirDirection) {
  const BumpField water = FieldOf(kWater);
  const Vector3d up = Vector3d::UnitZ();
  const auto variance = [&](int axis) {
    return MeanOver(up, [&](const Vector3d& p) {
      const Vector3d turned = water.At(p, up, kPoint).normal;
      return std::pow(turned[axis] / turned.z(), 2);
    });
  };
  // Of a Gaussian of directions: cos^2 has the mean (1 + exp(-2 sigma^2)) / 2.
  EXPECT_NEAR(variance(0) / (variance(0) + variance(1)), (1 + std::exp(-2 * 0.09)) / 2, 0.05);
}

// What a wide ray does not see singly is roughness: slopes and roughness together stay.
TEST(BumpField, WhatIsTooFineBecomesVariance) {
  const Vector3d up = Vector3d::UnitZ();
  for (const Bumps& bumps : {kStone, kWater}) {
    const BumpField field = FieldOf(bumps);
    double last = 0;
    for (const double width : {0.0, 0.003, 0.03, 0.3, 30.0}) {
      Eigen::Matrix<double, 3, 2> spread;
      spread << width, 0, 0, width, 0, 0;
      const double fine = field.At({0.1, 0.2, 0}, up, spread).variance;
      const double coarse = MeanOver(up, [&](const Vector3d& p) {
        return Slope(field.At(p, up, spread).normal, up).squaredNorm();
      });
      EXPECT_NEAR(std::sqrt(fine + coarse), bumps.rms_slope, 0.06 * bumps.rms_slope) << width;
      EXPECT_GE(fine, last);
      last = fine;
    }
    EXPECT_NEAR(std::sqrt(last), bumps.rms_slope, 0.06 * bumps.rms_slope);
  }
}

TEST(BumpField, IsAFunctionOfThePlaceInTheWorld) {
  const Vector3d up = Vector3d::UnitZ(), origin(100, 200, 0), p(3, 4, 5);
  const BumpField there(kStone, "m", up, origin);
  EXPECT_LT(
      (there.At(p - origin, up, kPoint).normal - FieldOf(kStone).At(p, up, kPoint).normal).norm(),
      1e-9);
  EXPECT_GT(
      (FieldOf(kStone, "n").At(p, up, kPoint).normal - FieldOf(kStone).At(p, up, kPoint).normal)
          .norm(),
      1e-3);
}

JsonNode Load(const std::string& text) {
  const auto path =
      std::filesystem::path(testing::TempDir()) / "insitu_radiometry" / "bumps" / "m.json";
  WriteWhole(path, text);
  return JsonNode::Load(path);
}

TEST(ReadBumps, ReadsWhatIsStatedAndFillsInTheRest) {
  EXPECT_FALSE(ReadBumps(MaterialKeys(Load("{}"))));
  const auto stone = ReadBumps(Load(R"({"bumps": {"rms_slope": 0.1, "scale_m": 0.32}})"));
  EXPECT_EQ(*stone, (Bumps{0.1, 0.32, 0.01}));
  const auto water = ReadBumps(Load(
      R"({"bumps": {"rms_slope": 0.05, "scale_m": 2, "shortest_m": 0.1, "spectrum": 1,
          "direction": [1, 0, 0], "spread_deg": 90}})"));
  EXPECT_EQ(water->spectrum, 1);
  EXPECT_NEAR(water->spread, M_PI / 2, 1e-12);
  Json::Value json;
  json["bumps"] = BumpsJson(*water);
  EXPECT_EQ(BumpsOf(Load(json.toStyledString()).At("bumps")), *water);
}

TEST(ReadBumps, FaultsNameTheValue) {
  const auto expect = [](const std::string& keys, const std::string& message) {
    try {
      ReadBumps(Load("{\"bumps\": {" + keys + "}}"));
      ADD_FAILURE() << keys;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  expect(R"("rms_slope": 0, "scale_m": 1)", "a slope above 0");
  expect(R"("rms_slope": 2, "scale_m": 1)", "at most 1");
  expect(R"("rms_slope": 0.1)", "scale_m");
  expect(R"("rms_slope": 0.1, "scale_m": -1)", "metres above 0");
  expect(R"("rms_slope": 0.1, "scale_m": 1, "shortest_m": 2)", "longer than scale_m");
  expect(R"("rms_slope": 0.1, "scale_m": 1, "spread_deg": 20)", "without direction");
  expect(R"("rms_slope": 0.1, "scale_m": 1, "direction": [0, 0, 0])", "is zero");
  expect(R"("rms_slope": 0.1, "scale_m": 1, "direction": [1, 0, 0], "spread_deg": 200)",
         "0 to 180");
}

}  // namespace
}  // namespace insitu
