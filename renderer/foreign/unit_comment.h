// SPDX-License-Identifier: GPL-3.0-or-later
// The unit that a comment names, in formats that have no word for it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace insitu {

struct UnitComment {
  std::string text;              // as it stands there
  std::optional<double> metres;  // nullopt: a unit that we do not know
};

// "Feet" -> 0.3048; in English, German, Italian or Spanish, or short. nullopt: not known.
std::optional<double> MetresOfUnitNamed(const std::string& name);

// "# File units = millimeters" as SketchUp writes it, "# units: inches", "#units mm", "all
// dimensions in cm", "1 unit = 0.01 meters" and the like.
// nullopt: the line is no comment on units.
std::optional<UnitComment> ReadUnitComment(std::string_view line);

// "its comment ... is taken as its unit", or names none that is known.
std::string UnitNote(const UnitComment& comment);

}  // namespace insitu
