// SPDX-License-Identifier: GPL-3.0-or-later
// Small drawings written in the tests, one pair of group code and value a line.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>

namespace insitu {

// "0 SECTION" becomes the lines "0" and "SECTION". Blank lines are skipped, so the value of the
// n-th pair stands on line 2 n.
inline std::string DxfText(const std::string& pairs) {
  std::istringstream lines(pairs);
  std::string line, text;
  while (std::getline(lines, line)) {
    const size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    const size_t blank = std::min(line.find(' ', begin), line.size());
    text += line.substr(begin, blank - begin) + "\n";
    text += line.substr(std::min(blank + 1, line.size())) + "\n";
  }
  return text;
}

inline std::string EntitiesSection(const std::string& entities) {
  return "0 SECTION\n 2 ENTITIES\n" + entities + "\n0 ENDSEC\n";
}

// A drawing in metres: `blocks` (BLOCK ... ENDBLK) and model space.
inline std::string DrawingText(const std::string& entities, const std::string& blocks = "") {
  return DxfText("0 SECTION\n 2 HEADER\n 9 $INSUNITS\n 70 6\n 0 ENDSEC\n" +
                 ("0 SECTION\n 2 BLOCKS\n" + blocks + "\n0 ENDSEC\n") + EntitiesSection(entities) +
                 "0 EOF\n");
}

// A unit square at this height as a 3DFACE on the given layer.
inline std::string UnitSquare(const std::string& layer, const std::string& z = "0") {
  const auto corner = [&z](int number, const std::string& x, const std::string& y) {
    const std::string n = std::to_string(number);
    return "1" + n + " " + x + "\n2" + n + " " + y + "\n3" + n + " " + z + "\n";
  };
  return "0 3DFACE\n 8 " + layer + "\n" + corner(0, "0", "0") + corner(1, "1", "0") +
         corner(2, "1", "1") + corner(3, "0", "1");
}

}  // namespace insitu
