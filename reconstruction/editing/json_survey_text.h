// SPDX-License-Identifier: GPL-3.0-or-later
// A JSON file of a site as a text: lists of rows, rows by name, and the root's other members.
#pragma once

#include <filesystem>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>

#include "reconstruction/editing/json_pieces.h"
#include "reconstruction/editing/survey_text.h"

namespace insitu {

class JsonSurveyText : public SurveyText {
 public:
  // Throws InputError at the line: not JSON, the root no object, a list that is none, a row that is
  // no object.
  JsonSurveyText(std::vector<EditedTable> tables, std::filesystem::path path,
                 const std::string& text);

  std::string text() const override;
  std::vector<const Json::Value*> Rows(const EditedTable& table) const override;
  const Json::Value* Find(const EditedTable& table, const Json::Value& row) const override;
  bool CanHold(const EditedTable& table, const std::string& field) const override;
  Json::Value Edit(const EditedTable& table, const Json::Value& before, const Json::Value& after,
                   const Json::Value& trace) override;

 private:
  using Pieces = std::list<JsonPiece>;
  // A table of many rows. `pieces` are the rows' texts; without rows the member reads `empty`,
  // where "" means that there is no such member.
  struct Listed {
    EditedTable table;
    JsonPieces pieces;
    std::string empty;
    std::list<Json::Value> rows;  // one a piece, in the same order
    struct Place {
      Pieces::iterator piece;
      std::list<Json::Value>::iterator row;
    };
    std::unordered_multimap<std::string, Place> places;
  };

  void Load(const std::string& text);
  void LoadList(Listed& listed, const std::string& value, const Json::Value& meaning);
  void CheckRows(const Listed& listed, const Json::Value& meaning, const std::string& text) const;
  void SyncMember(const Listed& listed);

  Json::Value EditRoot(const EditedTable& table, const Json::Value& after,
                       const Json::Value& trace);
  Json::Value Insert(Listed& listed, const Json::Value& after, const Json::Value& trace);
  Json::Value Erase(Listed& listed, Listed::Place place, const Json::Value& trace);
  Json::Value Change(Listed& listed, Listed::Place place, const Json::Value& after,
                     const Json::Value& trace);
  Json::Value MakeRoot();
  static std::optional<Listed::Place> FindPlace(const Listed& listed, const Json::Value& row,
                                                bool exactly);
  static void AddPlace(Listed& listed, Pieces::iterator piece,
                       std::list<Json::Value>::iterator row);
  static void RemovePlace(Listed& listed, const Listed::Place& place);
  JsonManner ItemManner(const Listed& listed, int depth) const;
  JsonPiece NewPiece(const Listed& listed, const Json::Value& row) const;

  std::vector<EditedTable> tables_;
  std::filesystem::path path_;
  std::string before_, after_;      // blanks about the root
  std::optional<JsonPieces> root_;  // nullopt: there is no file
  Json::Value root_row_;            // the root's members that are no tables
  std::map<std::string, Listed> lists_;
};

}  // namespace insitu
