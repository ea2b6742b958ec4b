// SPDX-License-Identifier: GPL-3.0-or-later
// ACIS save files, as drawings hold their solids: text (SAT) and binary (SAB) become the same
// records. Source: the SAT format as Spatial published it for version 4, and files of later ones.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace insitu {

struct AcisToken {
  enum class Kind { kNumber, kReference, kWord, kFlag };

  Kind kind = Kind::kNumber;
  double number = 0;  // of a flag: 0 or 1; of a reference: index into the records, -1: none
  std::string word;   // "reversed"; in binary files most such words are flags
};

struct AcisRecord {
  std::string type;  // "plane-surface"
  std::vector<AcisToken> tokens;
};

struct AcisFile {
  int version = 0;  // 400: ACIS 4.0
  std::vector<AcisRecord> records;

  // Whether a record is of a type or derived from it: "tcoedge-coedge" is a coedge.
  bool Is(int record, std::string_view type) const;
  // The record's references to records of a type, in their order.
  std::vector<int> References(int record, std::string_view type) const;
  int First(int record, std::string_view type) const;  // -1: none
};

// AutoCAD writes SAT into drawings with all characters but blanks turned about the middle of ASCII.
std::string DecodedAcisText(std::string_view text);

// nullopt: no such file, or a damaged one. Line ends matter in the head of a text only.
std::optional<AcisFile> ReadSat(std::string_view text);
std::optional<AcisFile> ReadSab(std::string_view bytes);

}  // namespace insitu
