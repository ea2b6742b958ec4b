// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/film_review.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr auto kAffine = FilmTransformation::kAffine;
const Eigen::Vector2i kSize(2500, 2480);

// Corners 1 to 4, middles of the edges 5 to 8, not quite symmetrical, as in a real camera.
std::map<std::string, Eigen::Vector2d> Certificate() {
  return {{"1", {-28.01, -27.98}}, {"2", {28.03, -28.02}}, {"3", {27.97, 28.04}},
          {"4", {-28.02, 28.01}},  {"5", {0.02, -29.5}},   {"6", {29.48, 0.01}},
          {"7", {-0.03, 29.52}},   {"8", {-29.51, -0.02}}};
}

// 40 px/mm, turned by an angle [deg], counter-clockwise on the screen.
Eigen::Matrix3d Scan(double turn_deg) {
  const double a = turn_deg * M_PI / 180;
  Eigen::Matrix3d map;
  map << 40 * std::cos(a), -40 * std::sin(a), 1250,  //
      -40 * std::sin(a), -40 * std::cos(a), 1240,    //
      0, 0, 1;
  return map;
}

std::vector<Fiducial> Placed(const std::vector<std::string>& names, double turn_deg = 1) {
  std::vector<Fiducial> marks;
  for (const std::string& name : names) {
    const Eigen::Vector2d image = Certificate().at(name);
    marks.push_back({name, image, (Scan(turn_deg) * image.homogeneous()).hnormalized()});
  }
  return marks;
}

const std::vector<std::string> kCorners = {"1", "2", "3", "4"};
const std::vector<std::string> kAll = {"1", "2", "3", "4", "5", "6", "7", "8"};

ScanReview Review(const std::vector<Fiducial>& marks) {
  return ReviewScan(marks, Certificate(), kAffine, kSize);
}

std::vector<std::string> Suspected(const std::vector<Fiducial>& marks) {
  return TextsOf(Review(marks).suspicions);
}

TEST(FilmReview, AKnownMapIsFound) {
  const ScanReview review = Review(Placed(kAll, 1));
  ASSERT_TRUE(review.map);
  EXPECT_LT((review.map->bitmap_from_image - Scan(1)).norm(), 1e-9);
  EXPECT_EQ(review.redundancy, 10);
  EXPECT_NEAR(review.px_per_mm, 40, 1e-9);
  EXPECT_NEAR(review.turn_deg, 1, 1e-9);
  EXPECT_THAT(review.suspicions, IsEmpty());
  EXPECT_TRUE(review.is_usable);
  double sum = 0;
  for (const Eigen::Vector2d& each : review.map->redundancies) sum += each.sum();
  EXPECT_NEAR(sum, 10, 1e-9);  // redundancies add up to that of the whole
}

// Of the corners of a square an affine map hides three quarters of an error: v = -error / 4.
TEST(FilmReview, ResidualsInPixelsAndMillimetres) {
  std::map<std::string, Eigen::Vector2d> square = {
      {"1", {-28, -28}}, {"2", {28, -28}}, {"3", {28, 28}}, {"4", {-28, 28}}};
  std::vector<Fiducial> marks;
  for (const auto& [name, image] : square) {
    marks.push_back({name, image, (Scan(0) * image.homogeneous()).hnormalized()});
  }
  marks[1].bitmap_px.x() += 0.8;
  const ScanReview review = ReviewScan(marks, square, kAffine, kSize);
  ASSERT_EQ(review.marks.size(), 4u);
  for (const FiducialReview& mark : review.marks) {
    EXPECT_NEAR(std::abs(mark.residual_px.x()), 0.2, 1e-9);
    EXPECT_NEAR(mark.residual_px.y(), 0, 1e-9);
    EXPECT_NEAR(std::abs(mark.residual_mm.x()), 0.2 / 40, 1e-5);
    EXPECT_NEAR(mark.redundancy, 0.25, 1e-9);
    EXPECT_NEAR(*mark.w, 0.2 / (kFiducialSigma_px * 0.5), 1e-9);
    EXPECT_NEAR(*mark.off_px, 0.8, 1e-9);
  }
}

TEST(FilmReview, ABlunderStandsOut) {
  std::vector<Fiducial> marks = Placed(kAll);
  marks[5].bitmap_px += Eigen::Vector2d(9, -12);
  const ScanReview review = Review(marks);
  EXPECT_EQ(review.marks[0].mark, "6");
  EXPECT_GT(*review.marks[0].w, 1.5 * *review.marks[1].w);
  EXPECT_NEAR(*review.marks[0].off_px, 15, 1e-6);
  EXPECT_THAT(TextsOf(review.suspicions),
              ElementsAre(HasSubstr("mark 6 lies 15.0 px (0.37 mm) from where the others put it")));
  EXPECT_FALSE(review.is_usable);
}

// Old film, whose marks fit badly without one being wrong, is told of and taken.
TEST(FilmReview, BuckledFilmIsUsable) {
  std::vector<Fiducial> marks = Placed(kAll);
  for (size_t i = 0; i < marks.size(); ++i) {
    marks[i].bitmap_px += Eigen::Vector2d(i % 2 ? 1.6 : -1.4, (i / 2) % 2 ? -1.5 : 1.7);
  }
  const ScanReview review = Review(marks);
  EXPECT_THAT(TextsOf(review.suspicions), ElementsAre(HasSubstr("px only")));
  EXPECT_TRUE(review.is_usable);
}

TEST(FilmReview, ThreeMarksCheckNothing) {
  const ScanReview review = Review(Placed({"1", "2", "3"}));
  ASSERT_TRUE(review.map);
  EXPECT_EQ(review.redundancy, 0);
  EXPECT_FALSE(review.map->sigma_px);
  for (const FiducialReview& mark : review.marks) EXPECT_FALSE(mark.w || mark.off_px);
  EXPECT_THAT(review.suspicions, IsEmpty());
}

// Even then no scanner stretches a scan.
TEST(FilmReview, AWrongMarkOfThreeStretchesTheScan) {
  std::vector<Fiducial> marks = Placed({"1", "2", "3"});
  marks[2].bitmap_px = Placed({"7"})[0].bitmap_px;
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("stretched")));
}

TEST(FilmReview, TwoMarksPredictTheOthers) {
  const ScanReview review = Review(Placed({"1", "2"}, 90));
  EXPECT_FALSE(review.map);
  EXPECT_EQ(review.needed, 3);
  ASSERT_EQ(review.predicted.size(), 6u);
  EXPECT_LT((review.predicted.at("7") - Placed({"7"}, 90)[0].bitmap_px).norm(), 1);
  EXPECT_THAT(Review({}).predicted, IsEmpty());
}

TEST(FilmReview, ExchangedMarks) {
  std::vector<Fiducial> marks = Placed(kAll);
  std::swap(marks[0].bitmap_px, marks[6].bitmap_px);
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("marks 1 and 7 are exchanged:")));
}

// Of four corners two opposite ones exchanged are the corners of a mirrored scan.
TEST(FilmReview, ExchangedMarksOfFour) {
  std::vector<Fiducial> marks = Placed(kCorners);
  std::swap(marks[0].bitmap_px, marks[1].bitmap_px);
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("marks 1 and 2 are exchanged:")));
  marks = Placed(kCorners);
  std::swap(marks[0].bitmap_px, marks[2].bitmap_px);
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("two opposite marks exchanged")));
  EXPECT_FALSE(Review(marks).is_usable);
}

TEST(FilmReview, AMarkOnTheWrongFiducial) {
  std::vector<Fiducial> marks = Placed({"1", "2", "3", "4", "5"});
  marks[4].bitmap_px = Placed({"7"})[0].bitmap_px;
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("mark 5 stands on mark 7")));
}

TEST(FilmReview, ColumnsExchanged) {
  std::vector<Fiducial> marks = Placed(kAll);
  for (Fiducial& mark : marks) std::swap(mark.image_mm.x(), mark.image_mm.y());
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("mirrored")));
  marks = Placed(kAll);
  std::swap(marks[5].image_mm.x(), marks[5].image_mm.y());
  EXPECT_THAT(Suspected(marks),
              ElementsAre(HasSubstr("x and y are exchanged of mark 6 in the certificate")));
  marks = Placed(kAll);
  marks[1].image_mm.x() *= -1;
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("x has the wrong sign of mark 2")));
}

TEST(FilmReview, OnOneLineAndAtOnePlace) {
  std::vector<Fiducial> marks = Placed({"1", "2", "3"});
  for (int i = 0; i < 3; ++i) marks[i].image_mm = {10.0 * i, 10.0 * i};
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("one line")));
  marks = Placed({"1", "2"});
  marks[1].bitmap_px = marks[0].bitmap_px;
  EXPECT_THAT(Suspected(marks), ElementsAre(HasSubstr("marks 1 and 2 stand at the same place")));
}

}  // namespace
}  // namespace insitu
