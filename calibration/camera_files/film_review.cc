// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/film_review.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

using Marks = std::vector<Fiducial>;
using Certified = std::map<std::string, Eigen::Vector2d>;

constexpr double kUnchecked = 0.01;      // redundancy below which a residual says nothing
constexpr double kShrinks = 0.005;       // film and scanners, of a length, at most
constexpr double kFits_px = 1;           // sigma of marks that fit
constexpr double kBad_w = 3.29;          // one good mark in a thousand gets there
constexpr double kSamePlace_px = 2;      // two marks cannot stand nearer
constexpr double kExplains = 5;          // by which an explanation must bring sigma down
constexpr double kSameMark_mm = 1;       // a mark seen there is the one of the certificate
constexpr size_t kMostExplanations = 3;  // told

Eigen::Vector2d At(const Eigen::Matrix3d& map, const Eigen::Vector2d& point) {
  return (map * point.homogeneous()).hnormalized();
}

bool IsMirrored(const Eigen::Matrix3d& bitmap_from_image) {
  return bitmap_from_image.topLeftCorner<2, 2>().determinant() > 0;  // y up to y down
}

double LargestResidual(const FilmMap& map) {
  double largest = 0;
  for (const auto& residual : map.residuals_px) largest = std::max(largest, residual.norm());
  return largest;
}

// Turn, scale and shift, y turned over: with p = x - i y (of the image), q = x + i y (of the
// bitmap), q = a p + b.
std::optional<Eigen::Matrix3d> FitSimilarity(const Marks& marks) {
  using Complex = std::complex<double>;
  if (marks.size() < 2) return std::nullopt;
  const double count = static_cast<double>(marks.size());
  Complex center_p = 0, center_q = 0, product = 0;
  double spread = 0;
  const auto p = [](const Fiducial& mark) {
    return Complex(mark.image_mm.x(), -mark.image_mm.y());
  };
  const auto q = [](const Fiducial& mark) {
    return Complex(mark.bitmap_px.x(), mark.bitmap_px.y());
  };
  for (const Fiducial& mark : marks) {
    center_p += p(mark) / count;
    center_q += q(mark) / count;
  }
  for (const Fiducial& mark : marks) {
    product += std::conj(p(mark) - center_p) * (q(mark) - center_q);
    spread += std::norm(p(mark) - center_p);
  }
  const Complex a = product / spread, b = center_q - a * center_p;
  if (!std::isfinite(std::abs(a)) || std::abs(a) == 0) return std::nullopt;
  Eigen::Matrix3d map;
  map << a.real(), a.imag(), b.real(), a.imag(), -a.real(), b.imag(), 0, 0, 1;
  return map;
}

// ---- one scan's marks, looked at ---------------------------------------------------------------

class Reviewer {
 public:
  Reviewer(const Marks& marks, const Certified& certified, FilmTransformation transformation,
           const Eigen::Vector2i& size)
      : marks_(marks),
        certified_(certified),
        transformation_(transformation),
        limit_px_(kShrinks * size.cast<double>().norm()) {}

  ScanReview Review() {
    const int elements = transformation_ == FilmTransformation::kAffine ? 6 : 8;
    review_.needed = elements / 2;
    review_.map = FitFilmMap(marks_, transformation_);
    SamePlaces();
    Predict();
    if (!review_.map) {
      if (static_cast<int>(marks_.size()) >= review_.needed) {
        Suspect(Sentence("filmOnLine", "the marks lie on one line: place one away from it"));
      }
      return std::move(review_);
    }
    review_.redundancy = static_cast<int>(2 * marks_.size()) - elements;
    Describe();
    ReviewMarks();
    const bool is_mistaken = !review_.suspicions.empty();
    review_.is_usable = Explain() && !is_mistaken;
    return std::move(review_);
  }

 private:
  void Suspect(const Sentence& sentence) { review_.suspicions.push_back(sentence); }

  void SamePlaces() {
    for (size_t i = 0; i < marks_.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        if ((marks_[i].bitmap_px - marks_[j].bitmap_px).norm() > kSamePlace_px) continue;
        Suspect(Sentence(
            "filmSamePlace",
            "marks {one} and {other} stand at the same place: one of them belongs elsewhere",
            {{"one", marks_[j].mark}, {"other", marks_[i].mark}}));
      }
    }
  }

  bool IsPlaced(const std::string& name) const {
    return std::any_of(marks_.begin(), marks_.end(),
                       [&](const Fiducial& mark) { return mark.mark == name; });
  }

  void Predict() {
    const auto similarity = FitSimilarity(marks_);
    if (!review_.map && !similarity) return;
    const Eigen::Matrix3d map = review_.map ? review_.map->bitmap_from_image : *similarity;
    for (const auto& [name, image_mm] : certified_) {
      if (!IsPlaced(name)) review_.predicted[name] = At(map, image_mm);
    }
  }

  void Describe() {
    const Eigen::Matrix2d linear = review_.map->bitmap_from_image.topLeftCorner<2, 2>();
    review_.px_per_mm = std::sqrt(std::abs(linear.determinant()));
    review_.turn_deg = -std::atan2(linear(1, 0), linear(0, 0)) * 180 / M_PI;  // bitmap's y is down
  }

  void ReviewMarks() {
    const FilmMap& map = *review_.map;
    const Eigen::Matrix3d image_from_bitmap = map.bitmap_from_image.inverse();
    for (size_t i = 0; i < marks_.size(); ++i) {
      const Eigen::Vector2d measured = At(image_from_bitmap, marks_[i].bitmap_px);
      FiducialReview mark{.mark = marks_[i].mark,
                          .residual_px = map.residuals_px[i],
                          .residual_mm = marks_[i].image_mm - measured,
                          .redundancy = map.redundancies[i].minCoeff()};
      if (review_.redundancy > 0 && mark.redundancy > kUnchecked) {
        const Eigen::Array2d sigma =
            kFiducialSigma_px * marks_[i].sigma_times * map.redundancies[i].array().sqrt();
        mark.w = (map.residuals_px[i].array().abs() / sigma).maxCoeff();
      }
      if (const auto others = FitFilmMap(Without(i), transformation_)) {
        mark.off_px =
            (At(others->bitmap_from_image, marks_[i].image_mm) - marks_[i].bitmap_px).norm();
      }
      review_.marks.push_back(mark);
    }
    std::stable_sort(review_.marks.begin(), review_.marks.end(),
                     [](const FiducialReview& a, const FiducialReview& b) {
                       return a.w.value_or(0) > b.w.value_or(0);
                     });
  }

  Marks Without(size_t i) const {
    Marks others = marks_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    return others;
  }

  // ---- what may have been mixed up ----

  // False: a mistake is found.
  bool Explain() {
    if (!review_.map->sigma_px || !IsMisfit()) return !SuspectMirrored() && HasShapeOfScan();
    Exchanged();
    WrongMark();
    WrongMillimetres();
    if (explained_.empty()) LeftOut();
    if (explained_.empty()) return !SuspectMirrored() && FitsUnexplained();
    TellExplanations();
    return false;
  }

  bool SuspectMirrored() {
    if (!IsMirrored(review_.map->bitmap_from_image)) return false;
    Suspect(Sentence(
        "filmMirrored",
        "the scan is mirrored against its marks: x and y of the certificate exchanged, y counted "
        "down, two opposite marks exchanged, or the film scanned from its back"));
    return true;
  }

  bool IsMisfit() const {
    return *review_.map->sigma_px > kFits_px ||
           std::any_of(review_.marks.begin(), review_.marks.end(),
                       [](const FiducialReview& mark) { return mark.w.value_or(0) > kBad_w; });
  }

  // Without redundancy a wrong mark still shows as a scan that is stretched or sheared.
  bool HasShapeOfScan() {
    const Eigen::Matrix2d linear = review_.map->bitmap_from_image.topLeftCorner<2, 2>();
    const Eigen::Vector2d scales = SingularValuesOf(linear).values;
    const double stretch = scales[0] / scales[1] - 1;
    if (stretch < 2 * kShrinks) return true;
    Suspect(Sentence("filmStretched",
                     "the scan would be stretched by {percent} % or sheared, which scanners do not "
                     "do: a mark stands on the wrong fiducial, or x or y of one is wrong",
                     {{"percent", Number("%.1f", 100 * stretch)}}));
    return false;
  }

  // Takes an explanation if with it the marks fit far better, as a scan from the front does.
  void Try(const Marks& marks, const Sentence& text) {
    const auto map = FitFilmMap(marks, transformation_);
    if (!map || !map->sigma_px || IsMirrored(map->bitmap_from_image)) return;
    if (*map->sigma_px > *review_.map->sigma_px / kExplains || LargestResidual(*map) > limit_px_) {
      return;
    }
    explained_.push_back({*map->sigma_px, text});
  }

  void Exchanged() {
    for (size_t i = 0; i < marks_.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        Marks marks = marks_;
        std::swap(marks[i].bitmap_px, marks[j].bitmap_px);
        Try(marks, Sentence("filmExchanged", "marks {one} and {other} are exchanged",
                            {{"one", marks_[j].mark}, {"other", marks_[i].mark}}));
      }
    }
  }

  // One that stands where a mark not placed yet must be.
  void WrongMark() {
    for (const auto& [name, image_mm] : certified_) {
      const bool is_placed = IsPlaced(name);
      for (size_t i = 0; !is_placed && i < marks_.size(); ++i) {
        Marks marks = marks_;
        marks[i].image_mm = image_mm;
        Try(marks, Sentence("filmWrongMark", "mark {one} stands on mark {other}",
                            {{"one", marks_[i].mark}, {"other", name}}));
      }
    }
  }

  void WrongMillimetres() {
    for (size_t i = 0; i < marks_.size(); ++i) {
      const Eigen::Vector2d& given = marks_[i].image_mm;
      const Sentence::Values mark = {{"mark", marks_[i].mark}};
      const Sentence swapped("filmSwapped",
                             "x and y are exchanged of mark {mark} in the certificate", mark);
      const Sentence wrong_x("filmWrongX", "x has the wrong sign of mark {mark} in the certificate",
                             mark);
      const Sentence wrong_y("filmWrongY", "y has the wrong sign of mark {mark} in the certificate",
                             mark);
      for (const auto& [image_mm, text] :
           {std::pair(Eigen::Vector2d(given.y(), given.x()), swapped),
            std::pair(Eigen::Vector2d(-given.x(), given.y()), wrong_x),
            std::pair(Eigen::Vector2d(given.x(), -given.y()), wrong_y)}) {
        if ((image_mm - given).norm() < kSameMark_mm) continue;
        Marks marks = marks_;
        marks[i].image_mm = image_mm;
        Try(marks, text);
      }
    }
  }

  void LeftOut() {
    for (size_t i = 0; i < marks_.size(); ++i) {
      const auto others = FitFilmMap(Without(i), transformation_);
      if (!others) continue;
      const double off =
          (At(others->bitmap_from_image, marks_[i].image_mm) - marks_[i].bitmap_px).norm();
      Try(Without(i), Sentence("filmOffOthers",
                               "mark {mark} lies {px} px ({mm} mm) from where the others put it",
                               {{"mark", marks_[i].mark},
                                {"px", Number("%.1f", off)},
                                {"mm", Number("%.2f", off / review_.px_per_mm)}}));
    }
  }

  // Whether insitu-calibrate takes them.
  bool FitsUnexplained() {
    const FilmMap& map = *review_.map;
    if (LargestResidual(map) > limit_px_) {
      const Sentence::Values off = {{"px", Number("%.1f", LargestResidual(map))}};
      constexpr int kTellsWhich = 3;  // redundancy from which a wrong mark stands out
      Suspect(review_.redundancy < kTellsWhich
                  ? Sentence("filmFewFit",
                             "the marks do not fit, off by up to {px} px: with so few marks it "
                             "cannot be told which is wrong; place more",
                             off)
                  : Sentence("filmSeveralWrong",
                             "the marks do not fit, off by up to {px} px: several are wrong; begin "
                             "with the worst",
                             off));
      return false;
    }
    if (*map.sigma_px > kFits_px) {
      Suspect(Sentence("filmBuckled",
                       "the marks fit to {px} px only: measure them again; of old or buckled film "
                       "try projective",
                       {{"px", Number("%.2f", *map.sigma_px)}}));
    }
    return true;
  }

  void TellExplanations() {
    std::stable_sort(explained_.begin(), explained_.end(),
                     [](const auto& a, const auto& b) { return a.sigma_px < b.sigma_px; });
    const double alike = 2 * std::max(explained_.front().sigma_px, kFiducialSigma_px);
    std::erase_if(explained_, [&](const auto& each) { return each.sigma_px > alike; });
    if (explained_.size() > kMostExplanations) explained_.resize(kMostExplanations);
    Sentence any = explained_.front().text;
    for (size_t i = 1; i < explained_.size(); ++i) {
      any = Sentence("filmOr", "{one}, or {other}",
                     {{"one", any.ToJson()}, {"other", explained_[i].text.ToJson()}});
    }
    Suspect(Sentence("filmExplained",
                     "{what}: without that they fit to {px} px instead of {now} px",
                     {{"what", any.ToJson()},
                      {"px", Number("%.2f", explained_.front().sigma_px)},
                      {"now", Number("%.2f", *review_.map->sigma_px)}}));
  }

  struct Explanation {
    double sigma_px;  // with it
    Sentence text;
  };

  const Marks& marks_;
  const Certified& certified_;
  const FilmTransformation transformation_;
  const double limit_px_;
  std::vector<Explanation> explained_;
  ScanReview review_;
};

}  // namespace

ScanReview ReviewScan(const std::vector<Fiducial>& marks,
                      const std::map<std::string, Eigen::Vector2d>& certified,
                      FilmTransformation transformation, const Eigen::Vector2i& size) {
  return Reviewer(marks, certified, transformation, size).Review();
}

}  // namespace insitu
