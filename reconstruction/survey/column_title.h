// SPDX-License-Identifier: GPL-3.0-or-later
// What a column of a table of any origin holds, by the words of its title in English, German,
// French or Italian.
#pragma once

#include <optional>
#include <string>

#include "calibration/files/sentence.h"

namespace insitu {

enum class Column {
  kName,
  kPhoto,
  kX,
  kY,
  kZ,
  kSigmaX,
  kSigmaY,
  kSigmaZ,
  kSigmaXy,
  kSigmaXyz,
  kEnabled,
  kRole,
  kOther
};

struct ColumnUnit {
  enum class Kind { kLength, kAngle, kPixel, kShare };
  Kind kind = Kind::kLength;
  double factor = 1;  // [m, deg or px] per unit
  std::string name;
};

struct ColumnTitle {
  std::string text;  // as it stands in the file
  Column column = Column::kOther;
  int rank = 0;                    // 0: the plain word alone; higher: among other words
  bool is_geographic = false;      // longitude or latitude
  bool is_ellipsoidal = false;     // a height above the ellipsoid
  bool is_letter_h = false;        // an accuracy "H": of the height, or horizontal beside a "V"
  bool is_map_axis = false;        // x or y by that letter: which of them is east?
  std::optional<ColumnUnit> unit;  // as stated
  Sentence fault;                  // why the column cannot be taken as it is; empty if it can
};

ColumnTitle ReadColumnTitle(const std::string& title);

// "mm", "US survey feet", "gon"; "ft" alone leaves open which foot, see PlainFoot. nullopt: no
// unit.
std::optional<ColumnUnit> UnitByName(const std::string& name);

// Whether a unit is "ft", without saying whose: US survey and international feet differ by 2 ppm.
bool IsPlainFoot(const ColumnUnit& unit);

// A quantity by the word of the option --column: "east", "sigma_height".
std::optional<Column> ColumnByName(const std::string& name);
std::string NameOf(Column column);

}  // namespace insitu
