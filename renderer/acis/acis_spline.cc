// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/acis_spline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using Kind = AcisToken::Kind;

constexpr double kHighestDegree = 25, kMostKnots = 10000, kFarthest = 1e12;

// Tokens from a place on, as numbers.
class NumberCursor {
 public:
  NumberCursor(const AcisRecord& record, size_t at) : tokens_(record.tokens), at_(at) {}

  void Skip() { ++at_; }
  double Next() {
    if (at_ < tokens_.size() && tokens_[at_].kind == Kind::kNumber &&
        std::abs(tokens_[at_].number) <= kFarthest) {
      return tokens_[at_++].number;
    }
    is_sound_ = false;
    return 0;
  }
  bool is_sound() const { return is_sound_; }

 private:
  const std::vector<AcisToken>& tokens_;
  size_t at_;
  bool is_sound_ = true;
};

// "nubs 3 open 2 0 3 1 3", then the poles: each knot with how often it comes, one less at the ends
// than elsewhere is written.
std::optional<AcisSpline> SplineAt(const AcisRecord& record, size_t at, bool is_rational) {
  NumberCursor cursor(record, at);
  AcisSpline spline;
  const double degree = cursor.Next();
  cursor.Skip();  // open, closed or periodic
  const double count = cursor.Next();
  if (!(degree >= 1) || degree > kHighestDegree || !(count >= 2) || count > kMostKnots) {
    return std::nullopt;
  }
  spline.degree = static_cast<int>(degree);
  for (int i = 0; i < count && cursor.is_sound(); ++i) {
    const double knot = cursor.Next(), times = cursor.Next();
    if (!(times >= 1) || times > kHighestDegree) return std::nullopt;
    if (!spline.knots.empty() && !(knot > spline.knots.back())) return std::nullopt;
    const bool is_end = i == 0 || i + 1 == count;
    spline.knots.insert(spline.knots.end(), static_cast<size_t>(times) + (is_end ? 1 : 0), knot);
  }
  const auto poles = std::ssize(spline.knots) - spline.degree - 1;
  for (std::ptrdiff_t i = 0; i < poles && cursor.is_sound(); ++i) {
    const double x = cursor.Next(), y = cursor.Next(), z = cursor.Next();
    spline.poles.emplace_back(x, y, z, is_rational ? cursor.Next() : 1);
    if (!(spline.poles.back().w() > 0)) return std::nullopt;
  }
  if (!cursor.is_sound() || poles <= spline.degree) return std::nullopt;
  return spline;
}

double TurnBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

Vector3d AcisSpline::PointAt(double parameter) const {
  const auto first = knots.begin() + degree, last = knots.end() - degree - 1;
  const double t = std::clamp(parameter, *first, *last);
  const auto next = std::upper_bound(first, last, t);
  const auto span = std::max(next, first + 1) - knots.begin() - 1;
  std::vector<Vector4d> row;
  for (std::ptrdiff_t i = span - degree; i <= span; ++i) {
    Vector4d pole = poles[static_cast<size_t>(std::min(i, std::ssize(poles) - 1))];
    pole.head<3>() *= pole.w();
    row.push_back(pole);
  }
  for (int level = 1; level <= degree; ++level) {
    for (int i = degree; i >= level; --i) {
      const auto knot = static_cast<size_t>(span - degree + i);
      const double low = knots[knot], high = knots[knot + 1 + degree - level];
      const double share = high > low ? (t - low) / (high - low) : 0;
      row[i] = (1 - share) * row[i - 1] + share * row[i];
    }
  }
  return row.back().head<3>() / row.back().w();
}

double AcisSpline::ParameterOf(const Vector3d& point) const {
  const auto samples = static_cast<int>(16 * poles.size());
  const double step = (end() - begin()) / samples;
  double best = begin(), least = (PointAt(best) - point).squaredNorm();
  for (int i = 1; i <= samples; ++i) {
    const double t = begin() + i * step;
    const double off = (PointAt(t) - point).squaredNorm();
    if (off >= least) continue;
    least = off;
    best = t;
  }
  double low = std::max(begin(), best - step), high = std::min(end(), best + step);
  for (int i = 0; i < 60; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    const bool is_low = (PointAt(a) - point).squaredNorm() < (PointAt(b) - point).squaredNorm();
    (is_low ? high : low) = is_low ? b : a;
  }
  return (low + high) / 2;
}

std::optional<AcisSpline> AcisSplineOf(const AcisRecord& record) {
  if (record.type != "intcurve-curve") return std::nullopt;
  for (size_t i = 0; i < record.tokens.size(); ++i) {
    const std::string& word = record.tokens[i].word;
    if (word == "nubs" || word == "nurbs") return SplineAt(record, i + 1, word == "nurbs");
  }
  return std::nullopt;
}

std::vector<Vector3d> SplinePoints(const AcisSpline& spline, double from, double to,
                                   double tolerance) {
  constexpr double kWidestTurn = std::numbers::pi / 12;
  constexpr int kMostPoints = 1024;
  std::vector<Vector3d> points;
  for (int count = 8; count <= kMostPoints; count *= 2) {
    points.clear();
    for (int i = 0; i <= count; ++i)
      points.push_back(spline.PointAt(from + (to - from) * i / count));
    bool is_fine = true;
    for (size_t i = 2; i < points.size() && is_fine; ++i) {
      const Vector3d before = points[i - 1] - points[i - 2], after = points[i] - points[i - 1];
      const double turn = TurnBetween(before, after);
      // An arc's sagitta: its chord times a quarter of half its turn.
      const double sagitta = std::max(before.norm(), after.norm()) * turn / 8;
      is_fine = turn <= kWidestTurn && sagitta <= tolerance;
    }
    if (is_fine) break;
  }
  return points;
}

}  // namespace insitu
