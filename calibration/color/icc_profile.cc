// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/icc_profile.h"

#include <lcms2.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "calibration/files/error.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, CloseProfile>;

struct DeleteTransform {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
using Transform = std::unique_ptr<void, DeleteTransform>;

struct FreeCurve {
  void operator()(cmsToneCurve* curve) const { cmsFreeToneCurve(curve); }
};
using Curve = std::unique_ptr<cmsToneCurve, FreeCurve>;

cmsCIExyY ChromaticityOf(const Eigen::Vector2d& xy) { return {xy.x(), xy.y(), 1}; }

Profile RgbProfile(const Primaries& primaries, cmsToneCurve* curve) {
  const cmsCIExyY white = ChromaticityOf(primaries.white);
  const cmsCIExyYTRIPLE corners = {ChromaticityOf(primaries.red), ChromaticityOf(primaries.green),
                                   ChromaticityOf(primaries.blue)};
  cmsToneCurve* const curves[3] = {curve, curve, curve};
  return Profile(cmsCreateRGBProfile(&white, &corners, curves));
}

void Describe(const Profile& profile, const std::string& name) {
  cmsMLU* text = cmsMLUalloc(nullptr, 1);
  cmsMLUsetASCII(text, "en", "US", name.c_str());
  cmsWriteTag(profile.get(), cmsSigProfileDescriptionTag, text);
  cmsMLUfree(text);
}

// Without the time of writing, which LittleCMS puts at bytes 24 to 35.
std::string BytesOf(const Profile& profile) {
  cmsUInt32Number size = 0;
  INSITU_CHECK(profile && cmsSaveProfileToMem(profile.get(), nullptr, &size));
  std::string bytes(size, '\0');
  INSITU_CHECK(cmsSaveProfileToMem(profile.get(), bytes.data(), &size));
  bytes.replace(24, 12, std::string("\x07\xea\0\1\0\1\0\0\0\0\0\0", 12));
  return bytes;
}

std::string NameOf(const Profile& profile) {
  char name[256] = {};
  cmsGetProfileInfoASCII(profile.get(), cmsInfoDescription, "en", "US", name, sizeof name);
  return *name ? name : "its ICC profile";
}

// At any place of [0, 1]; sampled ones by themselves, since LittleCMS rounds them to 16 bits.
double ValueOf(const cmsToneCurve& curve, double encoded) {
  if (cmsGetToneCurveParametricType(&curve) != 0) {
    return cmsEvalToneCurveFloat(&curve, static_cast<float>(encoded));
  }
  const int last = static_cast<int>(cmsGetToneCurveEstimatedTableEntries(&curve)) - 1;
  const cmsUInt16Number* table = cmsGetToneCurveEstimatedTable(&curve);
  const double at = encoded * last;
  const int i = std::max(0, std::min(static_cast<int>(at), last - 1));
  const int next = std::min(i + 1, last);
  return (table[i] + (at - i) * (table[next] - table[i])) / 65535.0;
}

std::optional<ToneCurve> ReadCurve(const Profile& profile, cmsTagSignature tag) {
  const auto* curve = static_cast<const cmsToneCurve*>(cmsReadTag(profile.get(), tag));
  if (!curve) return std::nullopt;
  ToneCurve read([&](double encoded) { return ValueOf(*curve, encoded); });
  if (!read.IsUsable()) return std::nullopt;
  return read;
}

std::optional<Eigen::Matrix3d> ReadColorants(const Profile& profile) {
  Eigen::Matrix3d columns;
  int column = 0;
  for (const auto tag : {cmsSigRedColorantTag, cmsSigGreenColorantTag, cmsSigBlueColorantTag}) {
    const auto* xyz = static_cast<const cmsCIEXYZ*>(cmsReadTag(profile.get(), tag));
    if (!xyz) return std::nullopt;
    columns.col(column++) = Eigen::Vector3d(xyz->X, xyz->Y, xyz->Z);
  }
  if (!columns.allFinite() || std::abs(columns.determinant()) < 1e-6) return std::nullopt;
  return columns;
}

// Whether matrix and curves are sRGB's within what its many writers rounded: a tenth of an 8-bit
// code.
bool IsSrgb(const ColorConversion& conversion) {
  for (int code = 0; code <= 255; code += 5) {
    for (int channel = 0; channel < 4; ++channel) {
      const Eigen::Vector3d encoded = channel < 3
                                          ? (Eigen::Vector3d::Unit(channel) * code / 255).eval()
                                          : Eigen::Vector3d::Constant(code / 255.0);
      const Eigen::Vector3d linear = encoded.unaryExpr(&LinearFromSrgb);
      const Eigen::Vector3d off = conversion.Linear(encoded) - linear;
      if (off.cwiseAbs().maxCoeff() > 1e-3) return false;
      const Eigen::Vector3d codes = conversion.Encoded(linear) - encoded;
      if (codes.cwiseAbs().maxCoeff() > 0.25 / 255) return false;
    }
  }
  return true;
}

// Through the tables of a profile.
class TableConversion : public ColorConversion {
 public:
  explicit TableConversion(Transform transform) : transform_(std::move(transform)) {}

  Eigen::Vector3d Linear(const Eigen::Vector3d& encoded) const override {
    const Eigen::Vector3f in = encoded.cast<float>();
    Eigen::Vector3f out;
    cmsDoTransform(transform_.get(), in.data(), out.data(), 1);
    return out.cast<double>();
  }

  // Gauss-Newton, damped, on the tables themselves: those for the way back are another
  // approximation, and cameras' profiles have none. In cube roots, so that dark differences count.
  Eigen::Vector3d Encoded(const Eigen::Vector3d& linear) const override {
    Eigen::Vector3d best = linear.cwiseMax(0).cwiseMin(1).unaryExpr(&SrgbFromLinear);
    double best_error = Error(best, linear).norm();
    double damping = 1e-6;
    for (int step = 0; step < 40 && best_error > 1e-6 && damping < 1e6; ++step) {
      const Eigen::Vector3d tried = Step(best, linear, damping);
      const double error = Error(tried, linear).norm();
      if (error < best_error) {
        best = tried;
        best_error = error;
        damping *= 0.1;
      } else {
        damping *= 10;
      }
    }
    return best;
  }

 private:
  Eigen::Vector3d Error(const Eigen::Vector3d& encoded, const Eigen::Vector3d& linear) const {
    const auto root = [](double value) { return std::cbrt(value); };
    return Linear(encoded).unaryExpr(root) - linear.unaryExpr(root);
  }
  Eigen::Vector3d Step(const Eigen::Vector3d& from, const Eigen::Vector3d& linear,
                       double damping) const {
    const Eigen::Vector3d error = Error(from, linear);
    Eigen::Matrix3d jacobian;
    for (int c = 0; c < 3; ++c) {
      const double step = from[c] < 0.5 ? 1e-3 : -1e-3;
      jacobian.col(c) = (Error(from + step * Eigen::Vector3d::Unit(c), linear) - error) / step;
    }
    const Eigen::Matrix3d normal =
        jacobian.transpose() * jacobian + damping * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d next = from - normal.ldlt().solve(jacobian.transpose() * error);
    return next.cwiseMax(0).cwiseMin(1);
  }

  const Transform transform_;
};

// Linear Rec. 709 as a profile, which does not clip.
Profile LinearRec709() {
  const Curve straight(cmsBuildGamma(nullptr, 1.0));
  return RgbProfile(kRec709, straight.get());
}

bool HasTables(const Profile& profile) {
  for (const auto tag :
       {cmsSigAToB0Tag, cmsSigAToB1Tag, cmsSigAToB2Tag, cmsSigDToB0Tag, cmsSigDToB1Tag}) {
    if (cmsIsTag(profile.get(), tag)) return true;
  }
  return false;
}

std::shared_ptr<const ColorConversion> ConversionByTables(const Profile& profile) {
  const cmsUInt32Number kFloats = TYPE_RGB_FLT;
  Transform transform(cmsCreateTransform(profile.get(), kFloats, LinearRec709().get(), kFloats,
                                         INTENT_RELATIVE_COLORIMETRIC,
                                         cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE));
  if (!transform) return nullptr;
  return std::make_shared<TableConversion>(std::move(transform));
}

std::shared_ptr<const ColorConversion> ConversionByMatrix(const Profile& profile) {
  const auto red = ReadCurve(profile, cmsSigRedTRCTag);
  const auto green = ReadCurve(profile, cmsSigGreenTRCTag);
  const auto blue = ReadCurve(profile, cmsSigBlueTRCTag);
  const auto colorants = ReadColorants(profile);
  if (!red || !green || !blue || !colorants) return nullptr;
  return MatrixConversion({*red, *green, *blue}, Rec709FromXyzD50() * *colorants);
}

[[noreturn]] void FailProfile(const fs::path& path, const std::string& what) {
  throw InputError(path, "its ICC profile " + what +
                             ", expected one that says what its colours are; convert the "
                             "photograph to sRGB");
}

// The profile without what follows it, of whole words, as PNG's library wants it.
std::string Tidied(const std::string& bytes, const fs::path& path) {
  constexpr size_t kLeast = 132;  // a header and a count of no tags
  uint32_t stated = 0;
  for (size_t i = 0; i < 4 && bytes.size() >= kLeast; ++i) {
    stated = stated << 8 | static_cast<unsigned char>(bytes[i]);
  }
  if (stated < kLeast || stated > bytes.size()) FailProfile(path, "is damaged");
  std::string tidied = bytes.substr(0, stated);
  tidied.resize((tidied.size() + 3) / 4 * 4, '\0');
  for (int i = 0; i < 4; ++i) tidied[i] = static_cast<char>(tidied.size() >> (24 - 8 * i) & 255);
  return tidied;
}

ColorSpace RgbSpace(const Profile& profile, const std::string& bytes, const fs::path& path) {
  ColorSpace space;
  space.name = NameOf(profile);
  space.conversion = HasTables(profile) ? ConversionByTables(profile) : ConversionByMatrix(profile);
  if (!space.conversion) FailProfile(path, "is damaged: it lacks curves, colorants or tables");
  space.profile = bytes;
  if (HasTables(profile) || !IsSrgb(*space.conversion)) return space;
  ColorSpace srgb;
  srgb.profile = bytes;
  return srgb;
}

// A montage has colours: its profile has the grey one's curve, with the primaries of sRGB.
ColorSpace GreySpace(const Profile& profile, const fs::path& path) {
  auto* curve = static_cast<cmsToneCurve*>(cmsReadTag(profile.get(), cmsSigGrayTRCTag));
  const auto read = ReadCurve(profile, cmsSigGrayTRCTag);
  if (!curve || !read) FailProfile(path, "is damaged: it lacks the curve of its grey");
  if (cmsGetPCS(profile.get()) != cmsSigXYZData) FailProfile(path, "counts its grey in L*");
  ColorSpace space;
  space.name = NameOf(profile);
  space.conversion = MatrixConversion({*read, *read, *read}, Eigen::Matrix3d::Identity());
  const Profile colored = RgbProfile(kRec709, curve);
  Describe(colored, space.name + ", with the primaries of sRGB");
  space.profile = BytesOf(colored);
  return space;
}

std::string SignatureText(cmsUInt32Number signature) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    const char letter = static_cast<char>(signature >> shift & 255);
    text += letter >= ' ' && letter <= '~' ? letter : '?';
  }
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

ColorSpace ReadIccProfile(const std::string& bytes, int channels, const fs::path& path) {
  const Profile profile(
      cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
  if (!profile) FailProfile(path, "is damaged");
  const auto kind = cmsGetDeviceClass(profile.get());
  if (kind != cmsSigInputClass && kind != cmsSigDisplayClass && kind != cmsSigOutputClass &&
      kind != cmsSigColorSpaceClass) {
    FailProfile(path, "is of class '" + SignatureText(kind) + "', which no photograph can have");
  }
  const auto colors = cmsGetColorSpace(profile.get());
  const auto expected = channels == 1 ? cmsSigGrayData : cmsSigRgbData;
  if (colors != expected) {
    FailProfile(path, "is for " + SignatureText(colors) + " but the file holds " +
                          (channels == 1 ? "grey" : "red, green and blue"));
  }
  return channels == 1 ? GreySpace(profile, path) : RgbSpace(profile, Tidied(bytes, path), path);
}

ColorSpace MakeColorSpace(const std::string& name, const Primaries& primaries,
                          const TransferFunction& transfer) {
  const ToneCurve curve(transfer);
  const double parameters[] = {transfer.g, transfer.a, transfer.b, transfer.c, transfer.d};
  const Curve parametric(cmsBuildParametricToneCurve(nullptr, 4, parameters));
  const Profile profile = RgbProfile(primaries, parametric.get());
  INSITU_CHECK(profile);
  Describe(profile, name);
  return {name,
          MatrixConversion({curve, curve, curve}, Rec709From(primaries)),
          BytesOf(profile),
          {},
          {}};
}

}  // namespace insitu
