// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/color_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace insitu {
namespace {

constexpr int kLastCode = 65535;

Eigen::Vector3d XyzOf(const Eigen::Vector2d& xy) {
  return {xy.x() / xy.y(), 1, (1 - xy.x() - xy.y()) / xy.y()};
}

class CurvesAndMatrix : public ColorConversion {
 public:
  CurvesAndMatrix(std::array<ToneCurve, 3> curves, const Eigen::Matrix3d& rec709)
      : curves_(std::move(curves)), rec709_(rec709), inverse_(rec709.inverse()) {}

  Eigen::Vector3d Linear(const Eigen::Vector3d& encoded) const override {
    Eigen::Vector3d linear;
    for (int c = 0; c < 3; ++c) linear[c] = curves_[c].Linear(encoded[c]);
    return rec709_ * linear;
  }
  Eigen::Vector3d Encoded(const Eigen::Vector3d& linear) const override {
    Eigen::Vector3d encoded = inverse_ * linear;
    for (int c = 0; c < 3; ++c) encoded[c] = curves_[c].Encoded(encoded[c]);
    return encoded;
  }

 private:
  const std::array<ToneCurve, 3> curves_;
  const Eigen::Matrix3d rec709_, inverse_;
};

}  // namespace

Eigen::Matrix3d XyzFromRgb(const Primaries& primaries) {
  Eigen::Matrix3d columns;
  columns << XyzOf(primaries.red), XyzOf(primaries.green), XyzOf(primaries.blue);
  const Eigen::Vector3d scales = columns.inverse() * XyzOf(primaries.white);
  return columns * scales.asDiagonal();
}

Eigen::Matrix3d Adaptation(const Eigen::Vector3d& from_white, const Eigen::Vector3d& to_white) {
  Eigen::Matrix3d cone;
  cone << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
  const Eigen::Vector3d gain = (cone * to_white).cwiseQuotient(cone * from_white);
  return cone.inverse() * gain.asDiagonal() * cone;
}

Eigen::Matrix3d Rec709From(const Primaries& primaries) {
  return XyzFromRgb(kRec709).inverse() * Adaptation(XyzOf(primaries.white), XyzOf(kRec709.white)) *
         XyzFromRgb(primaries);
}

Eigen::Matrix3d Rec709FromXyzD50() {
  const Eigen::Vector3d d50(0.9642, 1, 0.8249);
  return XyzFromRgb(kRec709).inverse() * Adaptation(d50, XyzOf(kRec709.white));
}

double TransferFunction::operator()(double encoded) const {
  return encoded >= d ? std::pow(std::max(0.0, a * encoded + b), g) : c * encoded;
}

ToneCurve::ToneCurve(const std::function<double(double)>& linear) : table_(kLastCode + 1) {
  double off = 0;
  for (int code = 0; code <= kLastCode; ++code) {
    const double encoded = static_cast<double>(code) / kLastCode;
    table_[code] = linear(encoded);
    off = std::max(off, std::abs(table_[code] - encoded));
  }
  is_straight_ = off < 1e-7;
}

bool ToneCurve::IsUsable() const {
  const bool is_finite =
      std::all_of(table_.begin(), table_.end(), [](double value) { return std::isfinite(value); });
  return is_finite && std::is_sorted(table_.begin(), table_.end()) &&
         std::abs(table_.front()) < 0.1 && std::abs(table_.back() - 1) < 0.1;
}

double ToneCurve::Linear(double encoded) const {
  if (is_straight_) return encoded;
  if (encoded < 0) return -Linear(-encoded);
  const double at = encoded * kLastCode;
  const int code = std::min(static_cast<int>(std::min(at, 1e6)), kLastCode - 1);
  return table_[code] + (at - code) * (table_[code + 1] - table_[code]);
}

double ToneCurve::Encoded(double linear) const {
  if (is_straight_) return linear;
  if (linear < 0) return -Encoded(-linear);
  const auto above = std::upper_bound(table_.begin(), table_.end(), linear);
  if (above == table_.begin()) return 0;
  const auto code = std::min<std::ptrdiff_t>(above - table_.begin(), kLastCode) - 1;
  const double step = table_[code + 1] - table_[code];
  return (code + (step > 0 ? (linear - table_[code]) / step : 1)) / kLastCode;
}

std::shared_ptr<const ColorConversion> MatrixConversion(std::array<ToneCurve, 3> curves,
                                                        const Eigen::Matrix3d& rec709) {
  return std::make_shared<CurvesAndMatrix>(std::move(curves), rec709);
}

Eigen::Vector3d ColorSpace::Linear(const Eigen::Vector3d& encoded) const {
  return conversion ? conversion->Linear(encoded) : encoded.unaryExpr(&LinearFromSrgb).eval();
}

Eigen::Vector3d ColorSpace::Encoded(const Eigen::Vector3d& linear) const {
  return conversion ? conversion->Encoded(linear) : linear.unaryExpr(&SrgbFromLinear).eval();
}

double LinearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double SrgbFromLinear(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace insitu
