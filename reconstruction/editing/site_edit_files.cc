// SPDX-License-Identifier: GPL-3.0-or-later
// Of SiteEdit what passes between the tables and the files.
#include <algorithm>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/error_at.h"
#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/editing/make_survey_text.h"
#include "reconstruction/editing/merge_rows.h"
#include "reconstruction/editing/site_edit.h"

namespace insitu {
namespace {

constexpr int kMostTries = 5;  // at writing a file that others write at the same time

std::filesystem::path PrepareFolder(const SitePaths& site) { return site.root / "work/prepare"; }

std::string HashOf(const std::string& text) { return text.empty() ? "" : Sha256OfText(text); }

// The last mark of that content; nullptr: none.
const FileMark* MarkOf(const std::vector<FileMark>& marks, const std::string& hash) {
  const auto mark = std::find_if(marks.rbegin(), marks.rend(),
                                 [&](const FileMark& each) { return each.hash == hash; });
  return mark == marks.rend() ? nullptr : &*mark;
}

// Up to which revision a file with that mark holds everything.
int SavedAt(const std::vector<FileMark>& marks, const FileMark& mark) {
  const FileMark* saved = &mark;
  while (saved != marks.data() && !saved->pending.empty()) --saved;
  return saved->pending.empty() ? saved->revision : 0;
}

Operation OutsideOperation(const SiteFile& file, int revision, std::vector<RowEdit> edits) {
  const std::string number = std::to_string(revision + 1);
  return {"outside " + number, "Changed in " + file.told + " by another program", std::move(edits)};
}

template <typename Items>
void AppendTo(Items& items, const Items& more) {
  items.insert(items.end(), more.begin(), more.end());
}

}  // namespace

SiteEdit::SiteEdit(SitePaths site, std::vector<std::string> photos, const HistoryLimits& limits)
    : site_(std::move(site)),
      photos_(std::move(photos)),
      lock_(site_, "insitu-prepare", PrepareFolder(site_) / ".lock"),
      history_(PrepareFolder(site_) / "journal.jsonl", limits),
      files_(SiteFiles(site_.root, PrepareFolder(site_) / "files")) {
  if (history_.remark()) found_.remarks.push_back(*history_.remark());
  RemoveLeftovers(site_.survey());
  RemoveLeftovers(site_.boards());
  RemoveLeftovers(PrepareFolder(site_));
  saved_revision_ = revision();
  for (SiteFile& file : files_) Open(file);
  history_.ForgetDone();
  if (is_saved()) saved_revision_ = revision();
  ShortenJournal(&found_);
}

// Once all is in the files and their copies, the journal need not tell how it came there. A journal
// that stays long is as good: what prevents it is said once.
void SiteEdit::ShortenJournal(OutsideChanges* told) {
  if (!history_.IsLong() || !can_shorten_) return;
  try {
    const bool is_settled = std::all_of(files_.begin(), files_.end(), [](const SiteFile& file) {
      return !file.is_changed && !file.fault && ReadIfThere(file.copy) == file.on_disk;
    });
    if (is_settled) history_.Shorten();
  } catch (const std::exception& error) {
    can_shorten_ = false;
    told->remarks.push_back(SentenceOf(error));
  }
}

// The file's content as its tables, without what the journal has on top.
void SiteEdit::ReadFirst(SiteFile& file, const std::string& on_disk) {
  try {
    file.now = MakeSurveyText(file.tables, file.path, on_disk);
    file.on_disk = on_disk;
    file.was_read = true;
  } catch (const InputError& error) {
    file.now = MakeSurveyText(file.tables, file.path, "");
    file.fault = FaultOf(file, error);
  }
}

// Finds which revision a content is of, ours as it was last written or as the copy has it, and does
// again what followed; then takes in what others did to the file since.
void SiteEdit::Open(SiteFile& file) {
  std::string on_disk, copy;
  try {
    on_disk = ReadIfThere(file.path);
    copy = ReadIfThere(file.copy);
  } catch (const InputError& error) {
    ReadFirst(file, "");
    file.was_read = false;
    file.fault = FaultOf(file, error);
    return;
  }
  const std::vector<FileMark>& marks = history_.MarksOf(file.name);
  const FileMark* of_copy = MarkOf(marks, HashOf(copy));
  const bool is_ours = !marks.empty() && marks.back().hash == HashOf(on_disk);
  const bool has_copy = !is_ours && of_copy;
  ReadFirst(file, has_copy ? copy : on_disk);
  if (file.fault) return;
  if (!marks.empty()) {
    const FileMark& mark = has_copy ? *of_copy : marks.back();
    Replay(file, mark);
    if (file.is_changed) saved_revision_ = std::min(saved_revision_, SavedAt(marks, mark));
  }
  if (on_disk != file.on_disk) TakeIn(file, on_disk, &found_);
  if (!file.is_changed && !file.fault) RememberOnDisk(file);
}

void SiteEdit::Replay(SiteFile& file, const FileMark& mark) {
  for (const RowEdit& edit : mark.pending) ReplayEdit(file, edit, Json::Value());
  for (const DoneEdits& done : history_.done()) {
    if (done.revision <= mark.revision) continue;
    for (size_t i = 0; i < done.edits.size(); ++i) {
      const bool has_trace = i < done.traces.size();
      ReplayEdit(file, done.edits[i], has_trace ? done.traces[i] : Json::Value());
    }
  }
  if (file.is_changed) file.is_changed = file.now->text() != file.on_disk;
}

void SiteEdit::ReplayEdit(SiteFile& file, const RowEdit& edit, const Json::Value& trace) {
  if (FindEditedTable(edit.table)->file != file.name) return;
  const auto text_of = [&](const EditedTable&) -> SurveyText& { return *file.now; };
  AppendTo(found_.conflicts, ApplyEdits({edit}, text_of, EqualRows::kAllowed, {trace}).conflicts);
  file.is_changed = true;
}

void SiteEdit::TakeIn(SiteFile& file, const std::string& on_disk, OutsideChanges* changes) {
  if (on_disk.empty() && file.was_read) {
    file.on_disk.clear();
    file.is_changed = true;
    changes->remarks.push_back(
        Sentence("fileRemoved", "{file} was removed; it is written again", {{"file", file.told}}));
    return;
  }
  if (!file.was_read) {
    ReadFirst(file, on_disk);
    if (!file.was_read) return;
    changes->reread.push_back(file.name);
    file.fault.reset();
    RememberOnDisk(file);
  } else {
    MergeIn(file, on_disk, changes);
  }
}

void SiteEdit::MergeIn(SiteFile& file, const std::string& on_disk, OutsideChanges* changes) {
  MergedText merged;
  try {
    merged = MergeText(file.tables, file.path, file.on_disk, *file.now, on_disk);
  } catch (const InputError& error) {
    file.fault = FaultOf(file, error);
    return;
  }
  if (!merged.outside.empty()) {
    const Operation operation = OutsideOperation(file, revision(), merged.outside);
    history_.AddOutside(operation);
    changes->operations.push_back(operation);
  }
  AppendTo(changes->conflicts, merged.conflicts);
  file.now = std::move(merged.text);
  file.on_disk = on_disk;
  file.fault.reset();
  file.is_changed = file.now->text() != on_disk;
  RememberOnDisk(file, merged.ours);
}

// So that the next start knows what this content was.
void SiteEdit::RememberOnDisk(const SiteFile& file, const std::vector<RowEdit>& pending) {
  Remember(file, file.on_disk, pending);
  const std::string copy = ReadIfThere(file.copy);
  if (copy == file.on_disk) return;
  if (ReplaceFile(file.copy, file.on_disk, copy)) {
    throw ErrorAt({file.copy}, Sentence("fileContended", "is written by another program"));
  }
}

void SiteEdit::Remember(const SiteFile& file, const std::string& text,
                        const std::vector<RowEdit>& pending) {
  const std::vector<FileMark>& marks = history_.MarksOf(file.name);
  const std::string hash = HashOf(text);
  const bool is_known = !marks.empty() && marks.back().hash == hash &&
                        marks.back().pending.empty() && pending.empty();
  if (!is_known) history_.AddMark(file.name, hash, pending);
}

OutsideChanges SiteEdit::Refresh() {
  OutsideChanges changes;
  for (SiteFile& file : files_) {
    try {
      const auto on_disk = ReadIfWritten(file);
      if (!on_disk) continue;
      TakeIn(file, *on_disk, &changes);
    } catch (const std::exception& error) {
      changes.remarks.push_back(SentenceOf(error));
    }
  }
  return changes;
}

void SiteEdit::SaveFile(SiteFile& file, SaveReport* report) {
  for (int tries = 0; tries < kMostTries; ++tries) {
    std::string other = ReadIfThere(file.path);
    if (other == file.on_disk) {
      const std::string text = file.now->text();
      if (text == file.on_disk) break;
      Remember(file, text);
      if (const auto meanwhile = ReplaceFile(file.path, text, file.on_disk)) {
        other = *meanwhile;
      } else {
        file.on_disk = text;
        report->written.push_back(file.name);
        break;
      }
    }
    TakeIn(file, other, &report->outside);
    if (file.fault) {
      report->faults.push_back(*file.fault);
      return;
    }
  }
  if (file.now->text() != file.on_disk) {
    throw ErrorAt({file.path},
                  Sentence("fileContendedLong", "is written by another program all the time"));
  }
  file.is_changed = false;
  file.seen = {};
  file.is_settled = false;
  RememberOnDisk(file);
}

SaveReport SiteEdit::Save() {
  SaveReport report;
  for (SiteFile& file : files_) {
    if (!file.is_changed) continue;
    try {
      SaveFile(file, &report);
    } catch (const std::exception& error) {
      report.faults.push_back(FaultOf(file, error));
    }
  }
  if (report.is_saved()) saved_revision_ = revision();
  ShortenJournal(&report.outside);
  return report;
}

}  // namespace insitu
