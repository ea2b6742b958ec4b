// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra given as tables: of materials and of light sources.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "calibration/files/json_file.h"
#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// Wavelength [nm], rising, and a value there; linear between, constant beyond.
using SpectralTable = std::vector<Eigen::Vector2d>;

// Rows [wavelength nm, value]. Throws InputError: fewer than two rows, wavelengths that do not
// rise, a negative value.
SpectralTable ReadSpectralTable(const JsonNode& rows);
// The same from a table of columns wavelength,value.
SpectralTable ReadSpectralTable(const std::filesystem::path& csv);

// Means over the bins; exact for the table's straight pieces.
Spectrum Sampled(const SpectralTable& table, const SpectralBins& bins);

// Relative power in steps of 5 nm, 380 to 780 nm, 1 at 560 nm.
SpectralTable D65Table();                     // CIE standard illuminant D65
SpectralTable BlackbodyTable(double kelvin);  // Planck's law
SpectralTable IlluminantATable();             // CIE 15: Planck's law at 2848 K * 1.435 / 1.4388

// Linear Rec. 709 of a light of this spectrum, at luminance 1; a channel outside the gamut is 0.
Eigen::Vector3d ColorOfLight(const SpectralTable& table);

// Linear Rec. 709 of a reflectance under D65, 0..1.
Eigen::Vector3d ColorOfReflectance(const SpectralTable& table);

// Linear Rec. 709 of CIELAB values; white point D65 (then as is) or D50 (adapted by Bradford).
Eigen::Vector3d LinearFromLab(const Eigen::Vector3d& lab, bool white_is_d50);

}  // namespace insitu
