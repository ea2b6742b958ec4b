// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of known shadows on surfaces of known scatter.
#include "renderer/shadows/shadow_separation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace insitu {
namespace {

using Eigen::Vector3f;

constexpr int kSize = 96;
const Vector3f kFall = Vector3f(0.31f, 0.36f, 0.42f).array().log();  // a clear sky's shade

struct Scene {
  std::function<bool(int, int)> is_shaded = [](int, int) { return false; };
  std::function<float(int, int)> stone = [](int, int) { return 0.0f; };  // ln of albedo, grey
  Vector3f fall = kFall;
  float scatter = 0.1f, tint = 0.02f;  // ln, of brightness and colour of stones
  float sky = 0;                       // ln: what the thing that shades takes of the sky
};

std::vector<SunPixel> Picture(const Scene& scene) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<SunPixel> pixels;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const float grey = scene.stone(x, y) + scene.scatter * normal(random);
      Vector3f lit = Vector3f(-1.1f, -1, -1.05f) + grey * Vector3f::Ones();
      for (int c = 0; c < 3; ++c) lit[c] += scene.tint * normal(random);
      if (scene.is_shaded(x, y)) lit += scene.fall + scene.sky * Vector3f::Ones();
      pixels.push_back({0, lit, scene.fall});
    }
  }
  return pixels;
}

// Shares of wrong pixels, of all.
double Wrong(const Scene& scene) {
  const SunShares shares = SeparateShadows(kSize, kSize, Picture(scene));
  int wrong = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const bool found = *shares.share.At(x, y) < 0.5f;
      wrong += found != scene.is_shaded(x, y) ? 1 : 0;
    }
  }
  return static_cast<double>(wrong) / (kSize * kSize);
}

bool InDisc(int x, int y, double radius) {
  return std::hypot(x - kSize / 2, y - kSize / 2) < radius;
}

TEST(SeparateShadows, AShadowOnStone) {
  for (const double radius : {8.0, 20.0, 40.0}) {
    EXPECT_LT(Wrong({.is_shaded = [=](int x, int y) { return InDisc(x, y, radius); }}), 0.002);
  }
  EXPECT_LT(Wrong({.is_shaded = [](int x, int y) { return InDisc(x, y, 20); }, .sky = -0.3f}),
            0.002);
}

TEST(SeparateShadows, StainsAreNoShadows) {
  const auto stain = [](int x, int y) { return InDisc(x, y, 12) ? -0.8f : 0.0f; };
  EXPECT_LT(Wrong({.stone = stain}), 0.002);
  const auto left = [](int x, int) { return x < 20; };
  EXPECT_LT(Wrong({.is_shaded = left, .stone = stain}), 0.002);
}

TEST(SeparateShadows, StonesThatDifferMuch) {
  const auto stones = [](int x, int y) { return (x / 8 + y / 8) % 2 == 0 ? -0.2f : 0.2f; };
  EXPECT_LT(Wrong({.stone = stones}), 0.002);
  EXPECT_LT(Wrong({.is_shaded = [](int x, int y) { return InDisc(x, y, 20); }, .stone = stones}),
            0.005);
}

TEST(SeparateShadows, WhatCannotBeJudgedIsLit) {
  std::vector<SunPixel> pixels = Picture({.is_shaded = [](int x, int) { return x < 30; }});
  for (SunPixel& pixel : pixels) pixel.surface = -1;
  SunShares shares = SeparateShadows(kSize, kSize, pixels);
  EXPECT_EQ(*shares.share.At(3, 3), 1);
  EXPECT_EQ(*shares.sigma.At(3, 3), 0);
  // A sun that hardly matters.
  const Scene dull{.is_shaded = [](int x, int) { return x < 30; },
                   .fall = Vector3f::Constant(-0.1f)};
  shares = SeparateShadows(kSize, kSize, Picture(dull));
  EXPECT_EQ(*shares.share.At(3, 3), 1);
}

// Sure within, unsure where its edge is drawn.
TEST(SeparateShadows, TellsHowSureItIs) {
  const SunShares shares = SeparateShadows(
      kSize, kSize, Picture({.is_shaded = [](int x, int) { return x < 48; }, .scatter = 0.3f}));
  EXPECT_LT(*shares.sigma.At(10, 50), 0.05);
  EXPECT_LT(*shares.sigma.At(90, 50), 0.05);
}

}  // namespace
}  // namespace insitu
