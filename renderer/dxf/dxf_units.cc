// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_units.h"

namespace insitu {
namespace {

constexpr double kSurveyFoot = 1200.0 / 3937;

// Indexed by $INSUNITS, from the DXF reference of AutoCAD.
constexpr double kMetres[] = {
    0,                                                 // unitless
    0.0254,                                            // inch
    0.3048,                                            // foot
    1609.344,                                          // mile
    1e-3,                                              // millimetre
    1e-2,                                              // centimetre
    1,                                                 // metre
    1e3,                                               // kilometre
    2.54e-8,                                           // microinch
    2.54e-5,                                           // mil
    0.9144,                                            // yard
    1e-10,                                             // angstrom
    1e-9,                                              // nanometre
    1e-6,                                              // micrometre
    1e-1,                                              // decimetre
    1e1,                                               // decametre
    1e2,                                               // hectometre
    1e9,                                               // gigametre
    149597870700.0,                                    // astronomical unit
    9460730472580800.0,                                // light year
    149597870700.0 * 648000 / 3.14159265358979323846,  // parsec
    kSurveyFoot,                                       // US survey foot
    kSurveyFoot / 12,                                  // US survey inch
    kSurveyFoot * 3,                                   // US survey yard
    kSurveyFoot * 5280,                                // US survey mile
};

}  // namespace

std::optional<double> MetresPerDxfUnit(int insunits) {
  constexpr int kUnits = sizeof(kMetres) / sizeof(kMetres[0]);
  if (insunits <= 0 || insunits >= kUnits) return std::nullopt;
  return kMetres[insunits];
}

}  // namespace insitu
