// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/response.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "calibration/files/json_file.h"

namespace insitu {
namespace {

// Slopes at the points: harmonic means of the neighbouring ones' by their lengths, which keeps a
// rising curve rising.
std::vector<double> SlopesAt(const ResponsePoints& points) {
  const size_t count = points.size();
  const auto width = [&](size_t i) { return points[i + 1].first - points[i].first; };
  const auto secant = [&](size_t i) {
    return (points[i + 1].second - points[i].second) / width(i);
  };
  std::vector<double> slopes(count);
  slopes.front() = secant(0);
  slopes.back() = secant(count - 2);
  for (size_t i = 1; i + 1 < count; ++i) {
    const double before = 2 * width(i) + width(i - 1), after = width(i) + 2 * width(i - 1);
    slopes[i] = (before + after) / (before / secant(i - 1) + after / secant(i));
  }
  return slopes;
}

ResponsePoints ReadPoints(const JsonNode& node) {
  ResponsePoints points;
  for (const JsonNode& item : node.Items()) {
    const std::vector<double> pair = item.Numbers();
    if (pair.size() != 2) throw item.Error("expected a pair of a code and its light");
    const bool rises = points.empty()
                           ? pair[0] == 0 && pair[1] == 0
                           : pair[0] > points.back().first && pair[1] > points.back().second;
    if (!rises) throw item.Error("expected codes and light that rise from [0, 0]");
    points.emplace_back(pair[0], pair[1]);
  }
  if (points.size() < 2 || points.back().first != 1) {
    throw node.Error("expected pairs from [0, 0] to the code 1");
  }
  return points;
}

std::array<ToneCurve, 3> ReadCurves(const JsonNode& entry) {
  if (const auto all = entry.Find("all")) {
    const ToneCurve curve = ResponseCurve(ReadPoints(*all));
    return {curve, curve, curve};
  }
  const auto of = [&](const char* channel) { return ResponseCurve(ReadPoints(entry.At(channel))); };
  return {of("red"), of("green"), of("blue")};
}

Eigen::Matrix3d ReadMatrix(const JsonNode& entry) {
  const auto node = entry.Find("matrix");
  if (!node) return Eigen::Matrix3d::Identity();
  std::vector<double> all;
  for (const JsonNode& row : node->Items()) {
    const std::vector<double> numbers = row.Numbers();
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  if (all.size() != 9) throw node->Error("expected three rows of three numbers");
  const Eigen::Matrix3d matrix =
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(all.data());
  if (std::abs(matrix.determinant()) < 1e-9) throw node->Error("expected a matrix with an inverse");
  return matrix;
}

struct StatedResponse {
  std::array<ToneCurve, 3> curves;
  Eigen::Matrix3d rec709;
};

// Of the photograph of that name; nullopt: nothing is said of it.
std::optional<StatedResponse> ResponseIn(const std::filesystem::path& file,
                                         const std::string& photo) {
  std::optional<StatedResponse> of_others;
  for (const JsonNode& entry : JsonNode::Load(file).At("curves").Items()) {
    const StatedResponse response = {ReadCurves(entry), ReadMatrix(entry)};
    const auto photos = entry.Find("photos");
    if (!photos) {
      of_others = response;
      continue;
    }
    const std::vector<std::string> names = photos->Texts();
    if (std::find(names.begin(), names.end(), photo) != names.end()) {
      return response;
    }
  }
  return of_others;
}

// Any colour space, then the curves, which count from what it shows as sRGB.
class ThenResponse : public ColorConversion {
 public:
  ThenResponse(ColorSpace stated, std::array<ToneCurve, 3> curves, const Eigen::Matrix3d& rec709)
      : stated_(std::move(stated)),
        curves_(std::move(curves)),
        rec709_(rec709),
        inverse_(rec709.inverse()) {}

  Eigen::Vector3d Linear(const Eigen::Vector3d& encoded) const override {
    Eigen::Vector3d linear = stated_.Linear(encoded);
    for (int c = 0; c < 3; ++c) linear[c] = curves_[c].Linear(SrgbFromLinear(linear[c]));
    return rec709_ * linear;
  }
  Eigen::Vector3d Encoded(const Eigen::Vector3d& linear) const override {
    Eigen::Vector3d shown = inverse_ * linear;
    for (int c = 0; c < 3; ++c) shown[c] = LinearFromSrgb(curves_[c].Encoded(shown[c]));
    return stated_.Encoded(shown);
  }

 private:
  const ColorSpace stated_;
  const std::array<ToneCurve, 3> curves_;
  const Eigen::Matrix3d rec709_, inverse_;
};

}  // namespace

ToneCurve ResponseCurve(const ResponsePoints& points) {
  const std::vector<double> slopes = SlopesAt(points);
  return ToneCurve([&](double code) {
    const auto above =
        std::upper_bound(points.begin() + 1, points.end() - 1, code,
                         [](double c, const auto& point) { return c < point.first; });
    const size_t i = above - points.begin() - 1;
    const double width = points[i + 1].first - points[i].first,
                 t = (code - points[i].first) / width;
    const double a = points[i].second, b = points[i + 1].second;
    const double light = a * (1 + 2 * t) * (1 - t) * (1 - t) + b * t * t * (3 - 2 * t) +
                         width * t * (1 - t) * (slopes[i] * (1 - t) - slopes[i + 1] * t);
    return light / points.back().second;
  });
}

ColorSpace WithResponse(const ColorSpace& stated, const std::array<ToneCurve, 3>& curves,
                        const Eigen::Matrix3d& rec709) {
  ColorSpace space = stated;
  space.name += ", with the response of response.json";
  space.has_response = true;
  if (stated.IsDefault()) {
    space.conversion = MatrixConversion(curves, rec709);
  } else {
    space.conversion = std::make_shared<ThenResponse>(stated, curves, rec709);
  }
  return space;
}

ColorSpace WithResponseBeside(const std::filesystem::path& photograph, const ColorSpace& stated) {
  const std::filesystem::path file = photograph.parent_path() / "response.json";
  if (!std::filesystem::is_regular_file(file)) return stated;
  const auto response = ResponseIn(file, photograph.stem().string());
  return response ? WithResponse(stated, response->curves, response->rec709) : stated;
}

}  // namespace insitu
