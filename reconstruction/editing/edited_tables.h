// SPDX-License-Identifier: GPL-3.0-or-later
// What can be edited of a site: tables of rows, each in a file of the site's. A row is a JSON
// object; CSV cells of number columns are numbers, other cells texts.
#pragma once

#include <json/value.h>

#include <string>
#include <vector>

namespace insitu {

enum class TableForm {
  kCsv,
  kList,     // a member of the file's root, an array of rows
  kMembers,  // a member of the file's root, an object; a row's "name" is its key there
  kRoot,     // the other members of the file's root are one row, which has no key
};

struct EditedTable {
  std::string name;
  std::string file;  // below the site's folder; film's may be in a folder of calibration/ instead
  TableForm form = TableForm::kCsv;
  std::string member = {};                // of the root, of lists and members
  std::vector<std::string> key = {};      // fields; empty: the whole row, or none (kRoot)
  std::vector<std::string> columns = {};  // in the order of a new file or item
  std::vector<std::string> numbers = {};  // those of the columns that are numbers
  bool has_state = false;                 // rows are on, off or dubious
  bool is_null_when_empty = false;        // readers refuse an empty list of these
};

// All of them; those of one file follow each other.
const std::vector<EditedTable>& EditedTables();

// nullptr: there is no such table.
const EditedTable* FindEditedTable(const std::string& name);

// Whether two values mean the same: numbers by value, null as if it were not there.
bool IsSameValue(const Json::Value& a, const Json::Value& b);

// The same of rows, or of null for "no row". Of CSV an empty cell is none, and a missing state is
// "on".
bool IsSameRow(const EditedTable& table, const Json::Value& a, const Json::Value& b);

// What tells a row from the others of its table.
std::string KeyOfRow(const EditedTable& table, const Json::Value& row);

// A text of a row's; "" if there is none.
std::string RowText(const Json::Value& row, const std::string& field);

// The fewest digits that give a number back.
std::string NumberText(const Json::Value& number);

// JSON on one line, UTF-8 kept, numbers by NumberText, keys sorted.
std::string OneLineJson(const Json::Value& value);

}  // namespace insitu
