// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a site as a history: what can be undone and redone, and which of it each file
// holds already.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "reconstruction/editing/journal.h"
#include "reconstruction/editing/operation.h"

namespace insitu {

// An operation that was done, with what takes it back.
struct HistoryStep {
  int revision = 0;
  Operation operation;
  std::vector<Json::Value> traces = {};
};

// Edits as they were done, to be done again on a text that lacks them.
struct DoneEdits {
  int revision = 0;
  std::vector<RowEdit> edits;
  std::vector<Json::Value> traces;  // they were done with, or empty
};

// A file was, or was about to be, written or read with this content, which holds everything up to
// the revision but for `pending`: edits of ours that were still to be made in it.
struct FileMark {
  std::string hash;
  int revision = 0;
  std::vector<RowEdit> pending = {};
};

// When a journal is made shorter, and what it holds then.
struct HistoryLimits {
  size_t entries = 10000;  // of the journal, from which on it is long
  size_t steps = 2000;     // that can be undone, and redone
  size_t ids = 20000;      // revisions whose ids are known, of pages that ask again
};

class SiteHistory {
 public:
  // Throws InputError as Journal does.
  explicit SiteHistory(const std::filesystem::path& journal, const HistoryLimits& limits = {});

  int revision() const { return revision_; }
  const std::optional<Sentence>& remark() const { return journal_.remark(); }
  const HistoryStep* ToUndo() const { return done_.empty() ? nullptr : &done_.back(); }
  const HistoryStep* ToRedo() const { return undone_.empty() ? nullptr : &undone_.back(); }

  // The revision that an id of Add... made; nullopt: not seen.
  std::optional<int> RevisionOf(const std::string& id) const;

  const std::vector<FileMark>& MarksOf(const std::string& file) const;

  // Everything that was done, as read; empty after ForgetDone.
  const std::vector<DoneEdits>& done() const { return read_; }
  void ForgetDone() { read_.clear(); }

  // Each puts an entry on disk first and throws InputError, nothing changed, if that fails.
  void AddEdit(const Operation& operation, const std::vector<Json::Value>& traces);
  void AddOutside(const Operation& operation);
  void AddUndo(const std::string& id);                                          // of ToUndo()
  void AddRedo(const std::string& id, const std::vector<Json::Value>& traces);  // of ToRedo()
  void DropUndo();  // ToUndo() cannot be undone any more
  void DropRedo();
  bool IsLong() const { return entry_count_ >= limits_.entries; }

  // Puts one entry in the place of all, the history within its limits: to be called while the last
  // mark of each file is of what the file and its copy hold, and holds all that was done. Throws
  // InputError: the journal is as it was.
  void Shorten();

  void AddMark(const std::string& file, const std::string& hash,
               const std::vector<RowEdit>& pending = {});

 private:
  void Do(const Json::Value& entry, bool is_reading);
  void DoStep(const Json::Value& entry, const std::string& kind, bool is_reading);
  void Begin(const Json::Value& entry);
  void Append(Json::Value entry);

  Journal journal_;
  HistoryLimits limits_;
  size_t entry_count_ = 0;  // of the journal, but for the one of Shorten
  int revision_ = 0;
  std::vector<HistoryStep> done_, undone_;
  std::vector<DoneEdits> read_;
  std::unordered_map<std::string, int> revision_of_id_;
  std::map<std::string, std::vector<FileMark>> marks_;
};

// The traces of an operation in the order of its inverse.
std::vector<Json::Value> Reversed(std::vector<Json::Value> traces);

}  // namespace insitu
