// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/color.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "radiometry/spectrum/cie_tables.h"

namespace insitu {
namespace {

constexpr double kStep = 5;  // [nm], of the tables

// The columns beside the wavelength, one row a wavelength from kFirstWavelength on.
Eigen::MatrixXd ParseTable(const std::string& csv, int columns) {
  std::istringstream lines(csv);
  std::string line, cell;
  std::getline(lines, line);
  std::vector<double> values;
  int rows = 0;
  for (; std::getline(lines, line) && !line.empty(); ++rows) {
    std::istringstream cells(line);
    std::getline(cells, cell, ',');
    INSITU_CHECK(std::stod(cell) == kFirstWavelength + rows * kStep);
    while (std::getline(cells, cell, ',')) values.push_back(std::stod(cell));
  }
  INSITU_CHECK(kFirstWavelength + (rows - 1) * kStep == kLastWavelength);
  INSITU_CHECK(static_cast<int>(values.size()) == rows * columns);
  return Eigen::MatrixXd::Map(values.data(), columns, rows).transpose();
}

const Eigen::MatrixXd& ObserverTable() {
  static const Eigen::MatrixXd table = ParseTable(kCie1931Csv, 3);
  return table;
}

const Eigen::MatrixXd& D65Table() {
  static const Eigen::MatrixXd table = ParseTable(kCieD65Csv, 1) / 100;
  return table;
}

Eigen::VectorXd Value(const Eigen::MatrixXd& table, double wavelength) {
  const double position = (wavelength - kFirstWavelength) / kStep;
  const int row = std::clamp(static_cast<int>(position), 0, static_cast<int>(table.rows()) - 2);
  const double t = position - row;
  return (1 - t) * table.row(row) + t * table.row(row + 1);
}

// Exact integral of the table, linear between its rows, over one bin.
Eigen::VectorXd Integral(const Eigen::MatrixXd& table, double first, double last) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(table.cols());
  for (double a = first; a < last;) {
    const double next_row =
        kFirstWavelength + (std::floor((a - kFirstWavelength) / kStep) + 1) * kStep;
    const double b = std::min(next_row, last);
    sum += (b - a) * Value(table, (a + b) / 2);
    a = b;
  }
  return sum;
}

Eigen::Vector3d Xyz(const Eigen::Vector2d& chromaticity) {
  return {chromaticity.x(), chromaticity.y(), 1 - chromaticity.sum()};
}

}  // namespace

Eigen::Matrix<double, 3, kMaxBins> ColorMatching(const SpectralBins& bins) {
  INSITU_CHECK(bins.count >= 3 && bins.count <= kMaxBins);
  Eigen::Matrix<double, 3, kMaxBins> matching = Eigen::Matrix<double, 3, kMaxBins>::Zero();
  for (int i = 0; i < bins.count; ++i) {
    matching.col(i) = Integral(ObserverTable(), bins.Edge(i), bins.Edge(i + 1));
  }
  return matching;
}

Spectrum IlluminantD65(const SpectralBins& bins) {
  Spectrum d65 = Spectrum::Zero();
  for (int i = 0; i < bins.count; ++i) {
    d65[i] = Integral(D65Table(), bins.Edge(i), bins.Edge(i + 1))[0] / bins.Width();
  }
  return d65;
}

Eigen::Vector3d Tristimulus(const Spectrum& stimulus, const SpectralBins& bins) {
  const Eigen::Matrix<double, 3, kMaxBins> matching = ColorMatching(bins);
  return matching * stimulus.matrix() / matching.row(1).sum();
}

double WeightOfD65(const Spectrum& radiance, const SpectralBins& bins) {
  return Tristimulus(radiance, bins).y() / Tristimulus(IlluminantD65(bins), bins).y();
}

Eigen::Vector3d Chromaticity(const Eigen::Vector3d& tristimulus) {
  INSITU_CHECK(tristimulus.sum() > 0);
  return tristimulus / tristimulus.sum();
}

RgbPrimaries Rec709() { return {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}; }

RgbPrimaries Ntsc1953() { return {{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {0.310, 0.316}}; }

RgbPrimaries DisplayP3() {
  return {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}};
}

RgbPrimaries Rec2020() {
  return {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
}

std::vector<SpectralColor> SpectrumLocus() {
  std::vector<SpectralColor> locus;
  for (int row = 0; row < ObserverTable().rows(); ++row) {
    const Eigen::Vector3d xyz = Chromaticity(ObserverTable().row(row).transpose());
    locus.push_back({kFirstWavelength + row * kStep, xyz.head<2>()});
  }
  return locus;
}

Eigen::Matrix3d RgbFromXyz(const RgbPrimaries& primaries) {
  Eigen::Matrix3d chromaticities;
  chromaticities << Xyz(primaries.red), Xyz(primaries.green), Xyz(primaries.blue);
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(chromaticities);
  if (!solver.isInvertible()) throw std::invalid_argument("the RGB primaries lie on one line");
  const Eigen::Vector3d white = Xyz(primaries.white) / primaries.white.y();
  const Eigen::Matrix3d xyz_from_rgb = chromaticities * solver.solve(white).asDiagonal();
  return xyz_from_rgb.inverse();
}

}  // namespace insitu
