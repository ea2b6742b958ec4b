// SPDX-License-Identifier: GPL-3.0-or-later
// What a name that nobody knows was probably meant to be.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"

namespace insitu {

// The known names nearest to `name`, at most three, in their order. First those that differ only in
// case, blanks, signs or leading zeros ("p 07" and "P7"); failing that those one slip of the
// keyboard away (a letter added, lost, replaced, or two exchanged), two in names of six letters and
// more. Empty if there are none, or more than three.
std::vector<std::string> NearNames(const std::string& name, const std::set<std::string>& known);

// What names have in common that differ only in case, blanks, signs, leading zeros or Unicode's
// form.
std::string EssenceOf(const std::string& name);

// What tells the points of a kind apart: the digits of a name, its numbers without leading zeros,
// and single letters that stand alone behind a sign: "f" in "wall_f_1".
std::string DigitsWithin(const std::string& name);

// Those of the same digits: 'P8' is another point than 'P7', not a slip of its name.
std::set<std::string> WithDigitsOf(const std::string& name, const std::set<std::string>& known);

// "; did you mean 'P7' or 'P8'?", to be put at a message's end; empty without near names.
Sentence SaidMeant(const std::string& name, const std::set<std::string>& known);
std::string DidYouMean(const std::string& name, const std::set<std::string>& known);

}  // namespace insitu
