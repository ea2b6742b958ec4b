// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/mark_proposal.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

namespace insitu {
namespace {

constexpr int kRadius = 40;

// Of a scene's brightness 0..1 at any place of the photograph, each pixel a mean of 8 x 8 places.
template <typename Scene>
GreyPatch PatchOf(const Scene& scene, const Eigen::Vector2i& center) {
  constexpr int kFine = 8;
  GreyPatch patch{cv::Mat(2 * kRadius + 1, 2 * kRadius + 1, CV_8U), center};
  for (int v = 0; v < patch.grey.rows; ++v) {
    for (int u = 0; u < patch.grey.cols; ++u) {
      double sum = 0;
      for (int i = 0; i < kFine * kFine; ++i) {
        const int column = i % kFine, row = i / kFine;
        const Eigen::Vector2d within((column + 0.5) / kFine - 0.5, (row + 0.5) / kFine - 0.5);
        sum += scene(Eigen::Vector2d(u - kRadius + center.x(), v - kRadius + center.y()) + within);
      }
      patch.grey.at<uchar>(v, u) = cv::saturate_cast<uchar>(40 + 170 * sum / (kFine * kFine));
    }
  }
  return patch;
}

const Eigen::Vector2d kCorner(100.3, 80.7);

double Quadrants(const Eigen::Vector2d& at) {
  return (at.x() < kCorner.x()) == (at.y() < kCorner.y()) ? 1 : 0;
}
double Edge(const Eigen::Vector2d& at) { return at.x() < kCorner.x() ? 1 : 0; }

TEST(RefineCorner, FindsACornerToATwentiethOfAPixel) {
  const auto found =
      RefineCorner(PatchOf(Quadrants, {101, 81}), kCorner + Eigen::Vector2d(0.9, -0.7));
  ASSERT_TRUE(std::holds_alternative<MarkProposal>(found)) << std::get<NoProposal>(found).text();
  const auto& proposal = std::get<MarkProposal>(found);
  EXPECT_LT((proposal.pixel - kCorner).norm(), 0.05);
  EXPECT_NEAR(proposal.shift_px, std::hypot(0.9, 0.7), 0.05);
  EXPECT_GE(proposal.sigma_px, 0.3);
}

TEST(RefineCorner, TellsAnEdgeAndAnEvenSurface) {
  const Eigen::Vector2d near_edge(100.5, 81);
  EXPECT_EQ(std::get<NoProposal>(RefineCorner(PatchOf(Edge, {100, 81}), near_edge)).text(),
            "an edge, no corner");
  const auto even = [](const Eigen::Vector2d&) { return 0.5; };
  EXPECT_EQ(std::get<NoProposal>(RefineCorner(PatchOf(even, {100, 81}), near_edge)).text(),
            "an even surface");
}

// Fiducial marks: a cross of thick lines, a dot, a ring.
double Cross(const Eigen::Vector2d& at) {
  const Eigen::Array2d off = (at - kCorner).array().abs();
  return off.minCoeff() < 1.4 && off.maxCoeff() < 14 ? 1 : 0;
}
double Dot(const Eigen::Vector2d& at) { return (at - kCorner).norm() < 5 ? 1 : 0; }
double Ring(const Eigen::Vector2d& at) { return std::abs((at - kCorner).norm() - 7) < 1 ? 1 : 0; }

TEST(RefineSymmetric, FindsTheCentreOfAFiducialMark) {
  for (const auto& scene : {Cross, Dot, Ring}) {
    const auto found =
        RefineSymmetric(PatchOf(scene, {101, 81}), kCorner + Eigen::Vector2d(2.2, -1.7));
    ASSERT_TRUE(std::holds_alternative<MarkProposal>(found)) << std::get<NoProposal>(found).text();
    const auto& proposal = std::get<MarkProposal>(found);
    EXPECT_LT((proposal.pixel - kCorner).norm(), 0.06);
    EXPECT_NEAR(proposal.shift_px, std::hypot(2.2, 1.7), 0.06);
  }
}

TEST(RefineSymmetric, TellsALineAndAnEvenSurface) {
  const Eigen::Vector2d near(100.5, 81);
  const auto line = [](const Eigen::Vector2d& at) {
    return std::abs(at.x() - 100) < 1.5 ? 1.0 : 0;
  };
  EXPECT_EQ(std::get<NoProposal>(RefineSymmetric(PatchOf(line, {100, 81}), near)).text(),
            "no centre of a mark within 4 px, or a line");
  const auto even = [](const Eigen::Vector2d&) { return 0.5; };
  EXPECT_EQ(std::get<NoProposal>(RefineSymmetric(PatchOf(even, {100, 81}), near)).text(),
            "an even surface, or too near the edge");
  EXPECT_EQ(std::get<NoProposal>(
                RefineSymmetric(PatchOf(Dot, {101, 81}), kCorner + Eigen::Vector2d(6, 3)))
                .text(),
            "no centre of a mark within 4 px, or a line");
}

// Blurred noise that looks alike nowhere.
class Texture {
 public:
  explicit Texture(unsigned seed) {
    std::mt19937 random(seed);
    cv::Mat noise(400, 400, CV_32F);
    for (int i = 0; i < 400 * 400; ++i)
      noise.at<float>(i / 400, i % 400) = static_cast<float>(random() % 1000) / 1000;
    cv::GaussianBlur(noise, blurred_, {}, 1.5);
    cv::normalize(blurred_, blurred_, 0, 1, cv::NORM_MINMAX);
  }
  double operator()(const Eigen::Vector2d& at) const {
    cv::Mat value;
    cv::getRectSubPix(blurred_, {1, 1}, {static_cast<float>(at.x()), static_cast<float>(at.y())},
                      value);
    return value.at<float>(0, 0);
  }

 private:
  cv::Mat blurred_;
};

TEST(MatchPatch, FindsAPlaceThatIsTurnedAndStretched) {
  const Texture texture(1);
  Eigen::Matrix2d other_from_photo;
  other_from_photo << 0.9, 0.2, -0.1, 1.1;
  const Eigen::Vector2d here(200.2, 190.6), there(150.4, 120.9);
  const Eigen::Matrix2d photo_from_other = other_from_photo.inverse();
  const auto in_other = [&](const Eigen::Vector2d& at) {
    return texture(here + photo_from_other * (at - there));
  };
  const auto found = MatchPatch(PatchOf(texture, {200, 191}), here, PatchOf(in_other, {153, 119}),
                                there + Eigen::Vector2d(3, -2), other_from_photo, 8);
  ASSERT_TRUE(std::holds_alternative<MarkProposal>(found)) << std::get<NoProposal>(found).text();
  EXPECT_LT((std::get<MarkProposal>(found).pixel - there).norm(), 0.15);
  EXPECT_GT(std::get<MarkProposal>(found).quality, 0.95);
}

TEST(MatchPatch, RefusesWhatLooksAlikeNowhereOrTwice) {
  const Eigen::Vector2d here(200, 200);
  const auto refusal = [&](const auto& scene, const auto& other) -> std::string {
    const auto found = MatchPatch(PatchOf(scene, {200, 200}), here, PatchOf(other, {200, 200}),
                                  here, Eigen::Matrix2d::Identity(), 12);
    const auto* proposal = std::get_if<MarkProposal>(&found);
    return proposal ? "quality " + std::to_string(proposal->quality)
                    : std::get<NoProposal>(found).text();
  };
  EXPECT_EQ(refusal(Texture(1), Texture(2)), "nothing there looks alike");
  const auto windows = [](const Eigen::Vector2d& at) {  // every 8 pixels another one
    return std::fmod(at.x(), 8) < 4 && std::fmod(at.y(), 8) < 4 ? 1.0 : 0.0;
  };
  EXPECT_EQ(refusal(windows, windows), "two places look alike");
}

TEST(OffsetsBetween, IsTheIdentityForOneCameraAndDoublesAtHalfTheDistance) {
  const Camera camera = Camera::Pinhole(1000, 1000, 500, 400, 1001, 801);
  const PosedCamera far{"far", camera, Rigid3{Eigen::Quaterniond::Identity(), {0, 0, 10}}};
  const PosedCamera near{"near", camera, Rigid3{Eigen::Quaterniond::Identity(), {0, 0, 5}}};
  const Eigen::Vector3d point = Eigen::Vector3d::Zero(), normal = -Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(OffsetsBetween(far, far, point, normal).isIdentity(1e-12));
  EXPECT_TRUE(
      OffsetsBetween(far, near, point, normal).isApprox(2 * Eigen::Matrix2d::Identity(), 1e-12));
}

}  // namespace
}  // namespace insitu
