// SPDX-License-Identifier: GPL-3.0-or-later
// A site's tables as they are edited. They are always what the files hold and what the journal has
// on top of that; whatever was confirmed is in the journal, so that a process that is killed loses
// nothing.
//
// work/prepare/ holds the journal, the lock and a copy of each file as it was last read or written,
// from which to tell who changed what. Deleting it, when all is saved, costs the history only.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "calibration/program/site_lock.h"
#include "reconstruction/editing/operation.h"
#include "reconstruction/editing/site_file.h"
#include "reconstruction/editing/site_history.h"

namespace insitu {

// A table that can be shown but not changed, since its file cannot be understood.
struct ReadOnlyTable {
  std::string table;
  FileFault fault;
};

struct EditOutcome {
  int revision = 0;
  std::optional<Operation> operation = {};  // what was done now
  bool is_repeated = false;                 // the id was done before; nothing was done now
  std::vector<RowConflict> conflicts = {};  // nothing was done: rows are not what was expected
  Sentence refused = {};                    // nothing was done: why; else empty

  bool is_done() const { return conflicts.empty() && refused.empty(); }
};

// What was found in the files that this object did not write.
struct OutsideChanges {
  std::vector<Operation> operations = {};   // already in the journal and the tables
  std::vector<RowConflict> conflicts = {};  // theirs (`current`) stands, ours (`after`) is kept in
                                            // the journal
  std::vector<std::string> reread = {};     // files that could not be read before
  std::vector<Sentence> remarks = {};       // for people
};

struct SaveReport {
  std::vector<std::string> written = {};  // files, below the site's folder
  std::vector<FileFault> faults = {};     // files that could not be written: tried again next time
  OutsideChanges outside = {};            // found on the way

  bool is_saved() const { return faults.empty(); }
};

// Not safe for several threads at once.
class SiteEdit {
 public:
  // `photos` are the names that rows may give. The folder survey/ may be missing. Throws
  // InputError: somebody else edits the site, the journal cannot be read or written.
  SiteEdit(SitePaths site, std::vector<std::string> photos, const HistoryLimits& limits = {});

  int revision() const { return history_.revision(); }
  int saved_revision() const { return saved_revision_; }
  bool is_saved() const;  // no file lacks anything

  std::vector<Json::Value> Rows(const std::string& table) const;
  Json::Value Tables() const;  // {"observations": [row, ...], ...}, all of them
  std::vector<ReadOnlyTable> read_only() const;
  std::optional<std::string> ToUndo() const;  // the label; nullopt: nothing
  std::optional<std::string> ToRedo() const;

  // What was found at the start: outside changes while nobody looked, a torn journal.
  const OutsideChanges& found() const { return found_; }

  // All throw InputError if the journal cannot be written: then nothing was done. An undo or redo
  // that is in conflict, since somebody else changed its rows, is dropped from the history.
  EditOutcome Apply(const Operation& operation);
  EditOutcome Undo(const std::string& id);
  EditOutcome Redo(const std::string& id);

  // Writes what the files lack, others' changes kept. Never throws for a file that fails.
  SaveReport Save();

  // Takes others' changes in; cheap if there are none.
  OutsideChanges Refresh();

  // Rows of a colleague's folder of the same site that are new here, as one operation; those that
  // differ are conflicts, those that cannot be taken are remarks.
  struct MergeReport {
    EditOutcome outcome = {};
    std::vector<RowConflict> conflicts = {};  // `current` ours, `after` theirs
    std::vector<Sentence> remarks = {};
  };
  MergeReport Merge(const SitePaths& other, const std::string& id);

 private:
  using TextOf = std::function<SurveyText&(const EditedTable&)>;

  void Open(SiteFile& file);
  void ReadFirst(SiteFile& file, const std::string& on_disk);
  void Replay(SiteFile& file, const FileMark& mark);
  void ReplayEdit(SiteFile& file, const RowEdit& edit, const Json::Value& trace);
  void TakeIn(SiteFile& file, const std::string& on_disk, OutsideChanges* changes);
  void MergeIn(SiteFile& file, const std::string& on_disk, OutsideChanges* changes);
  void Remember(const SiteFile& file, const std::string& text,
                const std::vector<RowEdit>& pending = {});
  void RememberOnDisk(const SiteFile& file, const std::vector<RowEdit>& pending = {});
  void ShortenJournal(OutsideChanges* told);
  void SaveFile(SiteFile& file, SaveReport* report);
  SiteFile& FileOf(const EditedTable& table);
  const SiteFile& FileOf(const EditedTable& table) const;
  Sentence RefusalOf(const std::vector<RowEdit>& edits, bool is_new) const;
  Sentence RefusalOfRow(const RowEdit& edit) const;
  EditOutcome Do(const Operation& operation, EqualRows equal_rows,
                 const std::vector<Json::Value>& traces,
                 const std::function<void(std::vector<Json::Value>)>& note);

  SitePaths site_;
  std::vector<std::string> photos_;
  SiteLock lock_;
  SiteHistory history_;
  std::vector<SiteFile> files_;
  OutsideChanges found_;
  int saved_revision_ = 0;
  bool can_shorten_ = true;  // the journal; else it was tried in vain
};

}  // namespace insitu
