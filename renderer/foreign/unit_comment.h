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

// "# File units = millimeters" as SketchUp writes it, "# units: inches", "#units mm" and the like.
// nullopt: the line is no comment on units.
std::optional<UnitComment> ReadUnitComment(std::string_view line);

// "its comment ... is taken as its unit", or names none that is known.
std::string UnitNote(const UnitComment& comment);

}  // namespace insitu
