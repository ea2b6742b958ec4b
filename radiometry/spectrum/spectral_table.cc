// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/spectral_table.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibration/files/csv_file.h"
#include "radiometry/spectrum/color.h"

namespace insitu {
namespace {

double ValueAt(const SpectralTable& table, double wavelength) {
  const auto above = std::ranges::lower_bound(table, wavelength, {},
                                              [](const Eigen::Vector2d& row) { return row.x(); });
  if (above == table.begin()) return table.front().y();
  if (above == table.end()) return table.back().y();
  const Eigen::Vector2d &a = *(above - 1), &b = *above;
  return a.y() + (b.y() - a.y()) * (wavelength - a.x()) / (b.x() - a.x());
}

double MeanOver(const SpectralTable& table, double first, double last) {
  double sum = 0, from = first;
  const auto add = [&](double to) {
    sum += (to - from) * (ValueAt(table, from) + ValueAt(table, to)) / 2;
    from = to;
  };
  for (const Eigen::Vector2d& row : table) {
    if (row.x() > first && row.x() < last) add(row.x());
  }
  add(last);
  return sum / (last - first);
}

// Throws through `error` what is wrong with row `i`.
template <typename MakeError>
void CheckRow(const SpectralTable& table, size_t i, const MakeError& error) {
  if (i > 0 && !(table[i].x() > table[i - 1].x())) {
    throw error("does not rise, expected wavelengths [nm] in order");
  }
  if (table[i].y() < 0) throw error("is negative, expected values of 0 or more");
}

constexpr double kPlanckConstant = 1.4388e7;  // second radiation constant [nm K]

double Planck(double nanometres, double kelvin) {
  const double x = kPlanckConstant / (nanometres * kelvin);
  return std::pow(nanometres, -5) / std::expm1(x);
}

template <typename Law>
SpectralTable TableOfLaw(const Law& law) {
  constexpr double kSpacing = 5, kReference = 560;
  SpectralTable table;
  for (double nm = kFirstWavelength; nm <= kLastWavelength; nm += kSpacing) {
    table.emplace_back(nm, law(nm) / law(kReference));
  }
  return table;
}

const SpectralBins kBins;

}  // namespace

SpectralTable ReadSpectralTable(const JsonNode& rows) {
  SpectralTable table;
  for (const JsonNode& row : rows.Items()) {
    const std::vector<double> values = row.Numbers();
    if (values.size() != 2) throw row.Error("has not two numbers, expected wavelength and value");
    table.emplace_back(values[0], values[1]);
    CheckRow(table, table.size() - 1, [&](const char* what) { return row.Error(what); });
  }
  if (table.size() < 2) throw rows.Error("has fewer than two rows, expected [wavelength, value]");
  return table;
}

SpectralTable ReadSpectralTable(const std::filesystem::path& csv) {
  SpectralTable table;
  for (const CsvRow& row : ReadCsv(csv, {"wavelength", "value"})) {
    table.emplace_back(row.Number("wavelength"), row.Number("value"));
    CheckRow(table, table.size() - 1, [&](const char* what) { return row.Error(what); });
  }
  if (table.size() < 2) throw InputError(csv, "has fewer than two rows, expected wavelength,value");
  return table;
}

Spectrum Sampled(const SpectralTable& table, const SpectralBins& bins) {
  Spectrum spectrum = Spectrum::Zero();
  for (int i = 0; i < bins.count; ++i) {
    spectrum[i] = MeanOver(table, bins.Edge(i), bins.Edge(i + 1));
  }
  return spectrum;
}

SpectralTable D65Table() {
  SpectralTable table;
  const Spectrum bins = IlluminantD65(kBins);
  for (int i = 0; i < kBins.count; ++i) table.emplace_back(kBins.Center(i), bins[i]);
  return table;
}

SpectralTable BlackbodyTable(double kelvin) {
  return TableOfLaw([kelvin](double nm) { return Planck(nm, kelvin); });
}

SpectralTable IlluminantATable() { return BlackbodyTable(2848 * 1.4388 / 1.435); }

Eigen::Vector3d ColorOfLight(const SpectralTable& table) {
  const Eigen::Vector3d xyz = Tristimulus(Sampled(table, kBins), kBins);
  return (RgbFromXyz(Rec709()) * (xyz / xyz.y())).cwiseMax(0);
}

Eigen::Vector3d ColorOfReflectance(const SpectralTable& table) {
  const Spectrum light = IlluminantD65(kBins);
  const double white = Tristimulus(light, kBins).y();
  const Eigen::Vector3d xyz = Tristimulus(light * Sampled(table, kBins), kBins) / white;
  return (RgbFromXyz(Rec709()) * xyz).cwiseMax(0).cwiseMin(1);
}

Eigen::Vector3d LinearFromLab(const Eigen::Vector3d& lab, bool white_is_d50) {
  const auto cube = [](double t) {
    constexpr double kLinear = 6.0 / 29;
    return t > kLinear ? t * t * t : 3 * kLinear * kLinear * (t - 4.0 / 29);
  };
  const double y = (lab.x() + 16) / 116;
  const Eigen::Vector3d relative(cube(y + lab.y() / 500), cube(y), cube(y - lab.z() / 200));
  const Eigen::Vector3d d65(0.95047, 1, 1.08883), d50(0.96422, 1, 0.82521);
  Eigen::Vector3d xyz = relative.cwiseProduct(white_is_d50 ? d50 : d65);
  if (white_is_d50) {
    Eigen::Matrix3d bradford;
    bradford << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
    const Eigen::Vector3d gain = (bradford * d65).cwiseQuotient(bradford * d50);
    xyz = bradford.inverse() * gain.asDiagonal() * bradford * xyz;
  }
  return RgbFromXyz(Rec709()) * xyz;
}

}  // namespace insitu
