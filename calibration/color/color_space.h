// SPDX-License-Identifier: GPL-3.0-or-later
// How the numbers of a photograph relate to linear Rec. 709: the one place that converts both ways.
//
// A curve a channel and a matrix, linear = M * curve(encoded), or what LittleCMS makes of a profile
// with tables. Nothing is clipped on the way in: colours beyond Rec. 709 are negative or above 1.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace insitu {

// CIE 1931 chromaticities (x, y).
struct Primaries {
  Eigen::Vector2d red, green, blue, white;
};

inline const Primaries kRec709 = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// Columns are XYZ of the primaries, scaled to make white at Y = 1 [SMPTE RP 177].
Eigen::Matrix3d XyzFromRgb(const Primaries& primaries);

// XYZ under the second white from XYZ under the first, by Bradford [ICC.1:2010, Annex E].
Eigen::Matrix3d Adaptation(const Eigen::Vector3d& from_white, const Eigen::Vector3d& to_white);

// Linear Rec. 709 from linear values of other primaries; white stays white.
Eigen::Matrix3d Rec709From(const Primaries& primaries);

// The same of XYZ relative to the D50 that profiles speak of.
Eigen::Matrix3d Rec709FromXyzD50();

// Light of one channel by its code. Beyond [0, 1] it goes on: below 0 mirrored, above 1 straight.
class ToneCurve {
 public:
  // `linear` of [0, 1]; never falls, and rises from about 0 to about 1: IsUsable() tells.
  explicit ToneCurve(const std::function<double(double)>& linear);

  bool IsUsable() const;
  double Linear(double encoded) const;
  double Encoded(double linear) const;  // the inverse

 private:
  std::vector<double> table_;  // at every 16-bit code
  bool is_straight_ = false;
};

// Y = (a X + b)^g for X >= d, else c X: ICC's parametric curve of type 3 [ICC.1:2010, 10.16].
struct TransferFunction {
  double g = 1, a = 1, b = 0, c = 0, d = 0;
  double operator()(double encoded) const;
};

inline constexpr TransferFunction kSrgbTransfer = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92,
                                                   0.04045};

// A conversion; any thread may use it.
class ColorConversion {
 public:
  virtual ~ColorConversion() = default;
  virtual Eigen::Vector3d Linear(const Eigen::Vector3d& encoded) const = 0;
  virtual Eigen::Vector3d Encoded(const Eigen::Vector3d& linear) const = 0;
};

// `rec709` is linear Rec. 709 from the curves' linear values.
std::shared_ptr<const ColorConversion> MatrixConversion(std::array<ToneCurve, 3> curves,
                                                        const Eigen::Matrix3d& rec709);

// A photograph's colour space. By default what a file means that states nothing: sRGB where it
// holds codes, linear Rec. 709 where it holds floating-point numbers.
struct ColorSpace {
  std::string name = "sRGB";                          // as people know it
  std::shared_ptr<const ColorConversion> conversion;  // none: the default
  std::string profile;  // ICC, for delivered pictures of three channels; empty: none is needed
  std::vector<float> chromaticities;  // of an EXR, as it states them; empty: none
  std::string assumption;             // what had to be assumed, with its remedy; empty: nothing
  bool has_response = false;          // a camera's (response.h), beside what the profile says

  bool IsDefault() const { return conversion == nullptr; }
  // Codes as [0, 1]. Of the default, sRGB.
  Eigen::Vector3d Linear(const Eigen::Vector3d& encoded) const;
  Eigen::Vector3d Encoded(const Eigen::Vector3d& linear) const;  // not clamped
};

// [0, 1] -> [0, 1], IEC 61966-2-1.
double LinearFromSrgb(double encoded);
double SrgbFromLinear(double linear);

}  // namespace insitu
